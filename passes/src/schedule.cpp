// SPDX-License-Identifier: MIT
// Which passes run, and in which order. The order is a walk from the exports towards the sources: a pass comes after
// what its slots need, in the order of its slots. It depends on exports and slots only, never on where a pass stands in
// the file, and it keeps a result close to its reader, so that images have short lifetimes.
#include "link.hpp"

#include <random>

namespace pelage::passes {
namespace {

class Scheduler {
public:
    explicit Scheduler(Linker& linker) : linker_(linker), marks_(linker.passes.size(), Mark::New) {}

    void run() {
        for (const std::uint32_t version : linker_.exportVersions) {
            if (version != none) keep(linker_.versions[version].producer);
        }
        std::vector<std::uint32_t> effects;
        for (std::uint32_t i = 0; i < linker_.passes.size(); ++i) {
            if (linker_.passes[i].enabled && linker_.passes[i].says->sideEffects) effects.push_back(i);
        }
        byName(effects);  // so that the file's order does not matter
        for (const std::uint32_t pass : effects) keep(pass);
        // A root that is kept for the next frame may keep others: the list grows while it is walked.
        for (std::size_t i = 0; i < roots_.size(); ++i) keepInputs(roots_[i]);
        cullRest();
        for (const std::uint32_t root : roots_) visit(root);
        if (linker_.options.order && !circle_) shuffle(*linker_.options.order);
        for (std::uint32_t i = 0; i < linker_.order.size(); ++i) linker_.passes[linker_.order[i]].place = i;
        warnAboutOldVersions();
    }

private:
    enum class Mark : std::uint8_t { New, Open, Done };

    void byName(std::vector<std::uint32_t>& list) const {
        if (list.size() < 2) return;
        std::sort(list.begin(), list.end(), [this](std::uint32_t a, std::uint32_t b) {
            return linker_.passes[a].says->name < linker_.passes[b].says->name;
        });
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    void keep(std::uint32_t pass) {
        if (pass != none) roots_.push_back(pass);
    }

    // Only data keeps a pass: that it must come before another one does not. A pass whose result the next frame reads
    // is a root of its own, because it need not come before the pass that reads it.
    void keepInputs(std::uint32_t root) {
        open_.push_back(root);
        while (!open_.empty()) {
            LinkedPass& pass = linker_.passes[open_.back()];
            open_.pop_back();
            if (pass.live) continue;
            pass.live = true;
            for (const LinkedSlot& slot : linker_.slotsOf(pass)) {
                ++linker_.visits;
                if (slot.in == none) continue;
                const Version& version = linker_.versions[slot.in];
                if (version.producer != none) open_.push_back(version.producer);
                const LinkedResource& resource = linker_.resources[version.resource];
                if (resource.plan.kind != PlanResource::Kind::History) continue;
                const std::size_t attachment =
                    static_cast<std::size_t>(resource.attachment - linker_.tree.attachments.data());
                const std::uint32_t written = linker_.ofAttachment[attachment];
                if (written != none) keep(linker_.versions[linker_.resources[written].last].producer);
            }
        }
    }

    void cullRest() {
        std::map<std::string, std::string> culled;
        for (const LinkedPass& pass : linker_.passes) {
            if (pass.live) continue;
            const std::string& name = pass.says->name;
            culled[name] =
                name + ": " + (pass.enabled ? "no export needs its result" : "switched off, " + linker_.whyOff(pass));
            // An export that this host does not want is not a fault of the file.
            if (!pass.enabled || !linker_.host.unwantedExports.empty()) continue;
            linker_.reporter.warning(pass.says->namePlace, "P048",
                                     "pass '" + name + "' is culled: no export needs its result",
                                     "export it, connect it, mark \"sideEffects\": true, or delete it");
        }
        for (auto& [name, text] : culled) linker_.plan.culled.push_back(std::move(text));
    }

    // Everything that must be done before a pass, in the order in which the walk takes it.
    template <class Use>
    void forEachBefore(std::uint32_t index, Use&& use) {
        const LinkedPass& pass = linker_.passes[index];
        for (const LinkedSlot& slot : linker_.slotsOf(pass)) {
            ++linker_.visits;
            if (slot.in != none) use(linker_.versions[slot.in].producer);
        }
        // A pass that reads an image as it was must be done before the image is changed.
        for (const LinkedSlot& slot : linker_.slotsOf(pass)) {
            if (slot.out == none || linker_.versions[slot.in].readers.empty()) continue;
            std::vector<std::uint32_t> readers = linker_.versions[slot.in].readers;
            byName(readers);
            for (const std::uint32_t reader : readers) {
                ++linker_.visits;
                if (reader != index) use(reader);
            }
        }
        for (const OrderedAfter& after : pass.says->after) use(after.index);
    }

    void visit(std::uint32_t index) {
        if (index == none || marks_[index] == Mark::Done || !linker_.passes[index].live || circle_) return;
        if (marks_[index] == Mark::Open) return circle(index);
        marks_[index] = Mark::Open;
        path_.push_back(index);
        forEachBefore(index, [this](std::uint32_t before) { visit(before); });
        path_.pop_back();
        marks_[index] = Mark::Done;
        linker_.order.push_back(index);
    }

    // Another valid order: again and again one of the passes that wait for nothing.
    void shuffle(std::uint32_t seed) {
        std::minstd_rand random(seed);
        std::vector<std::vector<std::uint32_t>> after(linker_.passes.size());
        std::vector<std::uint32_t> waits(linker_.passes.size(), 0), ready;
        for (const std::uint32_t index : linker_.order) {
            forEachBefore(index, [&](std::uint32_t before) {
                if (before == none || !linker_.passes[before].live) return;
                after[before].push_back(index);
                ++waits[index];
            });
            if (waits[index] == 0) ready.push_back(index);
        }
        linker_.order.clear();
        while (!ready.empty()) {
            std::swap(ready[random() % ready.size()], ready.back());
            const std::uint32_t index = ready.back();
            ready.pop_back();
            linker_.order.push_back(index);
            for (const std::uint32_t next : after[index]) {
                if (--waits[next] == 0) ready.push_back(next);
            }
        }
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

    // The slot that changes what `version` is, when its pass runs.
    const LinkedSlot* changer(const Version& version) const {
        if (version.modifier == none || !linker_.passes[version.modifier].live) return nullptr;
        return &linker_.slots[linker_.passes[version.modifier].firstSlot + version.modifierSlot];
    }

    void warnAboutOldVersions() {
        for (const std::uint32_t index : linker_.order) {
            for (const LinkedSlot& slot : linker_.slotsOf(linker_.passes[index])) {
                if (slot.in == none || slot.says->access != SlotAccess::Read) continue;
                const Version& version = linker_.versions[slot.in];
                const LinkedSlot* changed = changer(version);
                if (!changed || version.modifier == index) continue;
                const std::string& modifier = linker_.passes[version.modifier].says->name;
                linker_.reporter.warning(slot.source ? slot.source->place : slot.says->place, "P033",
                                         "'" + linker_.passes[index].says->name + "' reads '" +
                                             linker_.resources[version.resource].plan.name + "' as it was before '" +
                                             modifier + "' changed it",
                                         "did you mean '" + modifier + "." + changed->says->name + "'?");
            }
        }
        for (std::size_t i = 0; i < linker_.exportVersions.size(); ++i) {
            if (linker_.exportVersions[i] == none) continue;
            const Version& version = linker_.versions[linker_.exportVersions[i]];
            const LinkedSlot* changed = changer(version);
            if (!changed) continue;
            const ExportDeclaration& each = linker_.tree.exports[i];
            const std::string& modifier = linker_.passes[version.modifier].says->name;
            linker_.reporter.warning(each.fromPlace, "P033",
                                     "export '" + each.name + "' shows '" +
                                         linker_.resources[version.resource].plan.name + "' as '" + modifier +
                                         "' leaves it",
                                     "did you mean '" + modifier + "." + changed->says->name + "'?");
        }
    }

    Linker& linker_;
    std::vector<Mark> marks_;
    std::vector<std::uint32_t> roots_ = {}, open_ = {}, path_ = {};
    bool circle_ = false;
};

}  // namespace

void Linker::schedule() {
    Scheduler(*this).run();
}

}  // namespace pelage::passes
