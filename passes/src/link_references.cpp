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
            LinkedPass& pass = linker_.passes[i];
            if (!pass.enabled) continue;
            for (LinkedSlot& slot : pass.slots) resolve(i, slot);
        }
        for (const ExportDeclaration& each : linker_.tree.exports) exported(each);
    }

private:
    // The version that a slot's pass leaves, or none.
    std::uint32_t resultOf(const Reference& reference) {
        LinkedPass* pass = linker_.passNamed(reference.owner);
        if (!pass || !pass->enabled) return none;
        for (LinkedSlot& slot : pass->slots) {
            if (slot.says->name != reference.member) continue;
            resolve(static_cast<std::uint32_t>(pass - linker_.passes.data()), slot);
            return slot.out;
        }
        return none;
    }

    std::uint32_t versionFor(const Reference& reference) {
        switch (reference.root) {
            case Root::Pass:
                return resultOf(reference);
            case Root::Host:
                if (!linker_.conditions.imports[reference.member]) return none;
                [[fallthrough]];
            case Root::Attachment:
            case Root::Constant:
                return linker_.resources[linker_.resource(reference)].base;
        }
        return none;
    }

    // What readers of a disabled pass are given, when the reader names nothing else itself.
    std::uint32_t standInFor(const SlotDeclaration& says) {
        if (says.access != SlotAccess::Read) return none;
        for (const Reference& reference : says.connect) {
            const PassDeclaration* pass = reference.root == Root::Pass ? linker_.tree.pass(reference.owner) : nullptr;
            const SlotDeclaration* slot = pass ? pass->slot(reference.member) : nullptr;
            if (slot && slot->whenDisabled) return linker_.resources[linker_.resource(*slot->whenDisabled)].base;
        }
        return none;
    }

    void resolve(std::uint32_t passIndex, LinkedSlot& slot) {
        if (slot.state == State::Done || slot.state == State::Failed) return;
        const SlotDeclaration& says = *slot.says;
        const std::string title = linker_.passes[passIndex].says->name + "." + says.name;
        if (slot.state == State::Resolving) return circle(slot, title);
        slot.state = State::Resolving;
        chain_.push_back(title);
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
        if (slot.in == none) return missing(slot, title);
        if (says.access == SlotAccess::Read) {
            linker_.versions[slot.in].readers.push_back(passIndex);
        } else {
            modify(passIndex, slot, title);
        }
    }

    void modify(std::uint32_t passIndex, LinkedSlot& slot, const std::string& title) {
        Version& before = linker_.versions[slot.in];
        const std::string image = linker_.resources[before.resource].plan.name;
        if (before.modifier != none) {
            const std::string other = linker_.passes[before.modifier].says->name + "." + before.modifierSlot;
            linker_.reporter.error(slot.source ? slot.source->place : slot.says->place, "P034",
                                   "'" + image + "' is already " + (before.number == 0 ? "written" : "changed") +
                                       " by '" + linker_.passes[before.modifier].says->name + "'",
                                   "continue from '" + other + "' with access readWrite");
            slot.state = State::Failed;
            return;
        }
        before.modifier = passIndex;
        before.modifierSlot = title.substr(title.find('.') + 1);
        Version after{.resource = before.resource, .producer = passIndex, .number = before.number + 1};
        slot.out = static_cast<std::uint32_t>(linker_.versions.size());
        linker_.versions.push_back(std::move(after));
    }

    void missing(LinkedSlot& slot, const std::string& title) {
        const SlotDeclaration& says = *slot.says;
        if (says.optional || says.connect.empty()) return;
        slot.state = State::Failed;
        const Reference& last = says.connect.back();
        if (failedAlready(last)) return;
        if (last.root == Root::Host) {
            const ImportDeclaration* import = linker_.tree.import(last.member);
            linker_.reporter.error(import ? import->place : last.place, "H001",
                                   "the host does not lend '" + last.member + "', which '" + title + "' needs");
            return;
        }
        const LinkedPass* pass = linker_.passNamed(last.owner);
        linker_.reporter.error(last.place, "P044",
                               "'" + title + "' needs '" + last.text() + "', but '" + last.owner +
                                   "' is off: " + (pass ? pass->whyOff : "unknown"),
                               "name another source after it, or mark '" + title + "' optional");
    }

    // Whether the source has failed itself, so that its own report is the one to read.
    bool failedAlready(const Reference& reference) {
        const LinkedPass* pass = reference.root == Root::Pass ? linker_.passNamed(reference.owner) : nullptr;
        return pass && pass->enabled;
    }

    void circle(LinkedSlot& slot, const std::string& title) {
        slot.state = State::Failed;
        std::string text;
        bool inside = false;
        for (const std::string& each : chain_) {
            inside = inside || each == title;
            if (inside) text += each.substr(0, each.find('.')) + " -> ";
        }
        linker_.reporter.error(slot.says->connectPlace, "P046",
                               "passes wait for each other: " + text + title.substr(0, title.find('.')),
                               "break one of these connections");
    }

    void exported(const ExportDeclaration& each) {
        for (const Reference& reference : each.from) {
            const std::uint32_t version = reference.root == Root::Pass ? resultOf(reference) : none;
            if (version == none) continue;
            linker_.exportVersions[each.name] = version;
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
    std::vector<std::string> chain_ = {};
};

}  // namespace

std::uint32_t Linker::resource(const Reference& reference) {
    const auto [at, isNew] = resourceOf.emplace(reference.text(), static_cast<std::uint32_t>(resources.size()));
    if (!isNew) return at->second;
    LinkedResource made;
    made.plan.name = reference.text();
    made.base = static_cast<std::uint32_t>(versions.size());
    if (reference.root == Root::Host) {
        made.plan.kind = PlanResource::Kind::Import;
        made.import = tree.import(reference.member);
        made.plan.isBuffer = made.import && made.import->kind == ImportDeclaration::Kind::Buffer;
        made.plan.cube = made.import && made.import->kind == ImportDeclaration::Kind::ImageCube;
    } else if (reference.root == Root::Constant) {
        made.plan.kind = PlanResource::Kind::Constant;
    } else {
        made.attachment = tree.attachment(reference.member);
    }
    versions.push_back({.resource = at->second});
    resources.push_back(std::move(made));
    return at->second;
}

void Linker::resolveReferences() {
    Resolver(*this).run();
}

}  // namespace pelage::passes
