// SPDX-License-Identifier: MIT
// Which passes run, and in which order. The order is a walk from the exports towards the sources: a pass comes after
// what its slots need, in the order of its slots. It depends on exports and slots only, never on where a pass stands in
// the file, and it keeps a result close to its reader, so that images live shortly.
#include "link.hpp"

namespace pelage::passes {
namespace {

class Scheduler {
public:
    explicit Scheduler(Linker& linker) : linker_(linker), marks_(linker.passes.size(), Mark::New) {}

    void run() {
        std::vector<std::uint32_t> roots;
        for (const ExportDeclaration& each : linker_.tree.exports) {
            const auto found = linker_.exportVersions.find(each.name);
            if (found != linker_.exportVersions.end()) roots.push_back(linker_.versions[found->second].producer);
        }
        std::map<std::string, std::uint32_t> effects;  // by name, so that the file's order does not matter
        for (std::uint32_t i = 0; i < linker_.passes.size(); ++i) {
            if (linker_.passes[i].enabled && linker_.passes[i].says->sideEffects)
                effects[linker_.passes[i].says->name] = i;
        }
        for (const auto& [name, index] : effects) roots.push_back(index);
        for (const std::uint32_t root : roots) keep(root);
        cullRest();
        for (const std::uint32_t root : roots) visit(root);
        warnAboutOldVersions();
    }

private:
    enum class Mark : std::uint8_t { New, Open, Done };

    // Only data keeps a pass: that it must come before another one does not.
    void keep(std::uint32_t index) {
        if (index == none || linker_.passes[index].live) return;
        linker_.passes[index].live = true;
        for (const LinkedSlot& slot : linker_.passes[index].slots) {
            if (slot.in != none) keep(linker_.versions[slot.in].producer);
        }
    }

    void cullRest() {
        std::map<std::string, std::string> culled;
        for (const LinkedPass& pass : linker_.passes) {
            if (pass.live) continue;
            const std::string& name = pass.says->name;
            culled[name] = name + ": " + (pass.enabled ? "no export needs its result" : "switched off, " + pass.whyOff);
            if (!pass.enabled) continue;
            linker_.reporter.warning(pass.says->namePlace, "P048",
                                     "pass '" + name + "' is culled: no export needs its result",
                                     "export it, connect it, mark \"sideEffects\": true, or delete it");
        }
        for (auto& [name, text] : culled) linker_.plan.culled.push_back(std::move(text));
    }

    void visit(std::uint32_t index) {
        if (index == none || marks_[index] == Mark::Done || !linker_.passes[index].live || circle_) return;
        if (marks_[index] == Mark::Open) return circle(index);
        marks_[index] = Mark::Open;
        path_.push_back(index);
        const LinkedPass& pass = linker_.passes[index];
        for (const LinkedSlot& slot : pass.slots) {
            if (slot.in != none) visit(linker_.versions[slot.in].producer);
        }
        // Who reads an image as it was must be done before it is changed.
        for (const LinkedSlot& slot : pass.slots) {
            if (slot.out == none) continue;
            std::map<std::string, std::uint32_t> readers;
            for (const std::uint32_t reader : linker_.versions[slot.in].readers) {
                if (reader != index) readers[linker_.passes[reader].says->name] = reader;
            }
            for (const auto& [name, reader] : readers) visit(reader);
        }
        for (const OrderedAfter& after : pass.says->after) {
            if (const LinkedPass* other = linker_.passNamed(after.pass)) {
                visit(static_cast<std::uint32_t>(other - linker_.passes.data()));
            }
        }
        path_.pop_back();
        marks_[index] = Mark::Done;
        linker_.order.push_back(index);
    }

    void circle(std::uint32_t index) {
        circle_ = true;
        std::string text;
        bool inside = false;
        for (const std::uint32_t each : path_) {
            inside = inside || each == index;
            if (inside) text += linker_.passes[each].says->name + " -> ";
        }
        const PassDeclaration& says = *linker_.passes[index].says;
        linker_.reporter.error(says.namePlace, "P046", "passes wait for each other: " + text + says.name,
                               "break one of these connections");
    }

    void warnAboutOldVersions() {
        for (const std::uint32_t index : linker_.order) {
            for (const LinkedSlot& slot : linker_.passes[index].slots) {
                if (slot.in == none || slot.says->access != SlotAccess::Read) continue;
                const Version& version = linker_.versions[slot.in];
                if (version.modifier == none || version.modifier == index || !linker_.passes[version.modifier].live)
                    continue;
                const std::string modifier = linker_.passes[version.modifier].says->name;
                linker_.reporter.warning(slot.source ? slot.source->place : slot.says->place, "P033",
                                         "'" + linker_.passes[index].says->name + "' reads '" +
                                             linker_.resources[version.resource].plan.name + "' as it was before '" +
                                             modifier + "' changed it",
                                         "did you mean '" + modifier + "." + version.modifierSlot + "'?");
            }
        }
        for (const ExportDeclaration& each : linker_.tree.exports) {
            const auto found = linker_.exportVersions.find(each.name);
            if (found == linker_.exportVersions.end()) continue;
            const Version& version = linker_.versions[found->second];
            if (version.modifier == none || !linker_.passes[version.modifier].live) continue;
            const std::string modifier = linker_.passes[version.modifier].says->name;
            linker_.reporter.warning(each.fromPlace, "P033",
                                     "export '" + each.name + "' shows '" +
                                         linker_.resources[version.resource].plan.name + "' as '" + modifier +
                                         "' leaves it",
                                     "did you mean '" + modifier + "." + version.modifierSlot + "'?");
        }
    }

    Linker& linker_;
    std::vector<Mark> marks_;
    std::vector<std::uint32_t> path_ = {};
    bool circle_ = false;
};

}  // namespace

void Linker::schedule() {
    Scheduler(*this).run();
}

}  // namespace pelage::passes
