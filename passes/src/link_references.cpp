// SPDX-License-Identifier: MIT
// Every connection of an enabled pass becomes a version of an image. "write" and "readWrite" make the next version of
// what they are connected to; one version has at most one that changes it.
#include "link.hpp"

namespace pelage::passes {
namespace {

using Root = Reference::Root;
using State = LinkedSlot::State;

class Resolver {
public:
    explicit Resolver(Linker& linker) : linker_(linker) {}

    void run() {
        for (std::uint32_t i = 0; i < linker_.passes.size(); ++i) {
            if (!linker_.passes[i].enabled) continue;
            for (std::uint32_t slot = 0; slot < linker_.passes[i].slotCount; ++slot) resolve(i, slot);
        }
        linker_.exportVersions.assign(linker_.tree.exports.size(), none);
        for (std::size_t i = 0; i < linker_.tree.exports.size(); ++i) exported(i);
    }

private:
    struct Link {
        std::uint32_t pass, slot;
        bool operator==(const Link&) const = default;
    };

    LinkedSlot& at(Link link) { return linker_.slots[linker_.passes[link.pass].firstSlot + link.slot]; }
    const std::string& nameOf(std::uint32_t pass) const { return linker_.passes[pass].says->name; }
    std::string title(Link link) { return nameOf(link.pass) + "." + at(link).says->name; }

    // The version that a slot's pass leaves, or none.
    std::uint32_t resultOf(const Reference& reference) {
        if (reference.index == none || reference.slot == none || !linker_.passes[reference.index].enabled) return none;
        resolve(reference.index, reference.slot);
        return at({reference.index, reference.slot}).out;
    }

    std::uint32_t versionFor(const Reference& reference) {
        if (reference.root == Root::Pass) return resultOf(reference);
        if (reference.root == Root::Host && !linker_.conditions.imports[reference.member]) return none;
        return linker_.resources[linker_.resource(reference)].base;
    }

    // What readers of a disabled pass are given, when the reader names nothing else itself.
    std::uint32_t standInFor(const SlotDeclaration& says) {
        if (says.access != SlotAccess::Read) return none;
        for (const Reference& reference : says.connect) {
            if (reference.root != Root::Pass || reference.index == none || reference.slot == none) continue;
            const SlotDeclaration& slot = linker_.tree.passes[reference.index].slots[reference.slot];
            if (slot.whenDisabled) return linker_.resources[linker_.resource(*slot.whenDisabled)].base;
        }
        return none;
    }

    void resolve(std::uint32_t pass, std::uint32_t index) {
        const Link link{pass, index};
        LinkedSlot& slot = at(link);
        ++linker_.visits;
        if (slot.state == State::Done || slot.state == State::Failed) return;
        const SlotDeclaration& says = *slot.says;
        if (slot.state == State::Resolving) return circle(link);
        slot.state = State::Resolving;
        chain_.push_back(link);
        for (const Reference& reference : says.connect) {
            const std::uint32_t found = versionFor(reference);
            if (slot.state == State::Failed) break;  // this very slot was met again on the way
            if (found == none) continue;
            slot.in = found;
            slot.source = &reference;
            break;
        }
        chain_.pop_back();
        if (slot.state == State::Failed) return;
        slot.state = State::Done;
        if (slot.in == none) slot.in = standInFor(says);
        if (slot.in == none) return missing(link);
        if (says.access == SlotAccess::Read) {
            linker_.versions[slot.in].readers.push_back(pass);
        } else {
            modify(link);
        }
    }

    void modify(Link link) {
        LinkedSlot& slot = at(link);
        Version& before = linker_.versions[slot.in];
        LinkedResource& image = linker_.resources[before.resource];
        if (before.modifier != none) {
            linker_.reporter.error(
                slot.source ? slot.source->place : slot.says->place, "P034",
                "'" + image.plan.name + "' is already " + (before.number == 0 ? "written" : "changed") + " by '" +
                    nameOf(before.modifier) + "'",
                "continue from '" + title({before.modifier, before.modifierSlot}) + "' with access readWrite");
            slot.state = State::Failed;
            return;
        }
        before.modifier = link.pass;
        before.modifierSlot = link.slot;
        Version after{.resource = before.resource, .producer = link.pass, .number = before.number + 1};
        slot.out = static_cast<std::uint32_t>(linker_.versions.size());
        image.last = slot.out;
        linker_.versions.push_back(std::move(after));
    }

    void missing(Link link) {
        LinkedSlot& slot = at(link);
        const SlotDeclaration& says = *slot.says;
        if (says.optional || says.connect.empty()) return;
        slot.state = State::Failed;
        const Reference& last = says.connect.back();
        if (failedAlready(last)) return;
        if (last.root == Root::Host) {
            const ImportDeclaration* import = linker_.tree.import(last.member);
            linker_.reporter.error(import ? import->place : last.place, "P080",
                                   "the host does not lend '" + last.member + "', which '" + title(link) + "' needs");
            return;
        }
        const std::string why = last.index == none ? "unknown" : linker_.whyOff(linker_.passes[last.index]);
        linker_.reporter.error(
            last.place, "P044",
            "'" + title(link) + "' needs '" + last.text() + "', but '" + last.owner + "' is off: " + why,
            "name another source after it, or mark '" + title(link) + "' optional");
    }

    // Whether the source has failed itself, so that its own report is the one to read.
    bool failedAlready(const Reference& reference) {
        return reference.root == Root::Pass && reference.index != none && linker_.passes[reference.index].enabled;
    }

    void circle(Link link) {
        at(link).state = State::Failed;
        std::string text;
        bool inside = false;
        for (const Link& each : chain_) {
            inside = inside || each == link;
            if (inside) text += nameOf(each.pass) + " -> ";
        }
        linker_.reporter.error(at(link).says->connectPlace, "P046",
                               "passes wait for each other: " + text + nameOf(link.pass),
                               "break one of these connections");
    }

    void exported(std::size_t index) {
        const ExportDeclaration& each = linker_.tree.exports[index];
        if (has(linker_.host.unwantedExports, each.name)) return;
        for (const Reference& reference : each.from) {
            const std::uint32_t version = reference.root == Root::Pass ? resultOf(reference) : none;
            if (version == none) continue;
            linker_.exportVersions[index] = version;
            return;
        }
        if (each.optional || each.from.empty() || failedAlready(each.from.back())) return;
        const Reference& last = each.from.back();
        linker_.reporter.error(
            last.place, "P044",
            "export '" + each.name + "' needs '" + last.text() + "', but '" + last.owner + "' is off",
            "name another source after it, or mark the export optional");
    }

    Linker& linker_;
    std::vector<Link> chain_ = {};
};

}  // namespace

std::uint32_t Linker::resource(const Reference& reference) {
    std::uint32_t& known = reference.root == Root::Host       ? ofImport[reference.index]
                           : reference.root == Root::Constant ? ofConstant[reference.index]
                           : reference.root == Root::History  ? ofHistory[reference.index]
                                                              : ofAttachment[reference.index];
    if (known != none) return known;
    known = static_cast<std::uint32_t>(resources.size());
    LinkedResource made;
    made.plan.name = reference.text();
    made.base = made.last = static_cast<std::uint32_t>(versions.size());
    if (reference.root == Root::Host) {
        made.plan.kind = PlanResource::Kind::Import;
        made.import = &tree.imports[reference.index];
        made.plan.isBuffer = made.import->kind == ImportDeclaration::Kind::Buffer;
        made.plan.cube = made.import->kind == ImportDeclaration::Kind::ImageCube;
    } else if (reference.root == Root::Constant) {
        made.plan.kind = PlanResource::Kind::Constant;
    } else {
        made.attachment = &tree.attachments[reference.index];
        made.plan.isBuffer = made.attachment->isBuffer;
        if (reference.root == Root::History) made.plan.kind = PlanResource::Kind::History;
    }
    versions.push_back({.resource = known});
    resources.push_back(std::move(made));
    return known;
}

void Linker::resolveReferences() {
    ofAttachment.assign(tree.attachments.size(), none);
    ofHistory.assign(tree.attachments.size(), none);
    ofImport.assign(tree.imports.size(), none);
    ofConstant.assign(constantNames().size(), none);
    Resolver(*this).run();
}

}  // namespace pelage::passes
