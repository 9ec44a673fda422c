// SPDX-License-Identifier: MIT
// Faults of a tree that are there whatever the settings: words that name nothing, kinds that do not fit, and slots that
// some setting would leave without a source. References between passes are in check_references.cpp.
#include "check.hpp"

#include <set>

namespace pelage::passes {
namespace {

class Checker {
public:
    Checker(PassTree::Description& description, Reporter& reporter) : tree_(description), reporter_(reporter) {}

    void run() {
        passNames();
        for (const PassDeclaration& pass : tree_.passes) {
            passWords(pass);
            for (const SlotDeclaration& slot : pass.slots) slotWords(pass, slot);
            bindNames(pass);
            targets(pass);
        }
        for (const AttachmentDeclaration& attachment : tree_.attachments) attachmentWords(attachment);
        for (const ViewDeclaration& view : tree_.views) number(view.count, "count of view '" + view.name + "'");
        sizeCircles();
    }

private:
    void passNames() {
        std::map<std::string, Place> seen;
        for (const PassDeclaration& pass : tree_.passes) {
            for (const std::string_view reserved : {"att", "const", "history", "host", "setting"}) {
                if (pass.name == reserved) {
                    reporter_.error(pass.namePlace, "P001", "'" + pass.name + "' cannot be a pass name",
                                    "reserved: att, const, history, host, setting");
                }
            }
            const auto [first, isNew] = seen.emplace(pass.name, pass.namePlace);
            if (!isNew) {
                reporter_.error(pass.namePlace, "P002", "second pass named '" + pass.name + "'",
                                "first at " + reporter_.at(first->second));
            }
        }
    }

    void passWords(const PassDeclaration& pass) {
        const std::string title = "pass '" + pass.name + "'";
        const bool isClass = !pass.passClass.empty();
        // What a class does with a list is its own affair: it draws it, or dispatches the materials' compute shaders.
        const bool listed = isClass || pass.kind == PassKind::Raster;
        if (listed && !pass.drawList.empty() && !has(namesOf(tree_.drawLists), pass.drawList)) {
            reporter_.error(pass.drawListPlace, "P011", title + ": unknown draw list '" + pass.drawList + "'",
                            didYouMean(pass.drawList, namesOf(tree_.drawLists), "add it to \"drawLists\""));
        }
        if (!isClass && pass.kind == PassKind::Raster) {
            if (pass.drawList.empty()) reporter_.error(pass.place, "P010", "raster " + title + " has no \"drawList\"");
            if (pass.view.empty()) reporter_.error(pass.place, "P024", "raster " + title + " has no \"view\"");
        } else if (!isClass) {
            if (!pass.drawList.empty())
                reporter_.error(pass.drawListPlace, "P024", title + " draws no list: it is not a raster pass",
                                "remove \"drawList\"");
            if (pass.forEachLayer)
                reporter_.error(pass.place, "P024", title + " cannot repeat for each view: it is not a raster pass",
                                "remove \"forEachView\"");
        }
        if (!pass.view.empty() && !tree_.view(pass.view)) {
            reporter_.error(pass.viewPlace, "P029", title + ": unknown view '" + pass.view + "'",
                            didYouMean(pass.view, namesOf(tree_.views), "add it to \"views\""));
        }
        const bool shaded = pass.kind == PassKind::Fullscreen || pass.kind == PassKind::Compute;
        if (!isClass && shaded && pass.shader.file.empty())
            reporter_.error(pass.place, "P012", std::string(word(pass.kind)) + " " + title + " has no \"shader\"");
        if (isClass && !pass.shader.file.empty())
            reporter_.error(pass.shader.place, "P024", title + " has a \"shader\", but its class records it",
                            "remove it");
        dispatchSlot(pass, pass.dispatchLike, pass.dispatchPlace);
        if (const SlotDeclaration* slot = dispatchSlot(pass, pass.dispatchIndirect, pass.indirectPlace);
            slot && slot->use != SlotUse::Indirect) {
            reporter_.error(pass.indirectPlace, "P023",
                            "slot '" + pass.name + "." + slot->name + "' is " + std::string(word(slot->use)) +
                                "; \"dispatchIndirect\" needs one used as indirect",
                            R"(write "as": "indirect")");
        }
        for (const OrderedAfter& after : pass.after) {
            if (!tree_.pass(after.pass)) {
                reporter_.error(after.place, "P016", "unknown pass '" + after.pass + "'",
                                didYouMean(after.pass, namesOf(tree_.passes)));
            }
        }
        for (const ConstantDeclaration& constant : pass.constants) settingName(constant.value);
        if (!isClass && pass.kind == PassKind::Copy && !pass.constants.empty()) {
            reporter_.error(pass.constants.front().place, "P024", title + " has \"constants\" but no shader",
                            "remove them");
        }
        for (const ParameterDeclaration& parameter : pass.parameters) settingName(parameter.value);
    }

    const SlotDeclaration* dispatchSlot(const PassDeclaration& pass, const std::string& name, Place place) {
        const SlotDeclaration* slot = name.empty() ? nullptr : pass.slot(name);
        if (!slot && !name.empty()) {
            reporter_.error(place, "P014", "pass '" + pass.name + "' has no slot '" + name + "'",
                            didYouMean(name, pass.slotNames()));
        }
        return slot;
    }

    void slotWords(const PassDeclaration& pass, const SlotDeclaration& slot) {
        const std::string title = "slot '" + pass.name + "." + slot.name + "'";
        const std::string use(word(slot.use));
        const bool bound = slot.use == SlotUse::Sampled || slot.use == SlotUse::Storage || slot.use == SlotUse::Uniform;
        const bool target = slot.use == SlotUse::Color || slot.use == SlotUse::Depth;
        const bool isClass = !pass.passClass.empty();
        // What a class records is known when the tree is compiled.
        if (!isClass && !fits(pass.kind, slot.use)) {
            reporter_.error(slot.place, "P023",
                            title + " is of a use that a " + std::string(word(pass.kind)) + " pass cannot have");
            return;
        }
        const bool readOnly = slot.use == SlotUse::Sampled || slot.use == SlotUse::Uniform ||
                              slot.use == SlotUse::Vertex || slot.use == SlotUse::Indirect;
        if (readOnly && slot.access != SlotAccess::Read) {
            reporter_.error(slot.place, "P023", title + " is " + use + ", which can only be read",
                            "use \"storage\" or \"color\"");
        }
        if (slot.use == SlotUse::Color && slot.access == SlotAccess::Read) {
            reporter_.error(slot.place, "P023", title + " is a color target that is only read", "use \"sampled\"");
        }
        if (bound && slot.bind.empty()) {
            reporter_.error(slot.place, "P020", title + " is " + use + " but has no \"bind\"",
                            "name the shader resource");
        } else if (!bound && !slot.bind.empty()) {
            reporter_.error(slot.bindPlace, "P020", title + " has a \"bind\" but is " + use, "remove it");
        }
        const bool zeroed = slot.clearIsZero && slot.use == SlotUse::Storage && slot.access != SlotAccess::Read;
        if (zeroed) {
            // Whether it is a buffer is seen at its connections (P037).
        } else if (slot.clearIsZero && target) {
            reporter_.error(slot.clearPlace, "P027", title + " is a " + use + " target",
                            slot.use == SlotUse::Depth ? R"(write {"depth": "far"})" : "write [r, g, b, a]");
        } else if (slot.hasClear && target && slot.clearIsDepth != (slot.use == SlotUse::Depth)) {
            reporter_.error(slot.clearPlace, "P027", title + " is a " + use + " target",
                            slot.clearIsDepth ? "write [r, g, b, a]" : R"(write {"depth": "far"})");
        } else if (slot.hasClear && (!target || slot.access == SlotAccess::Read)) {
            reporter_.error(slot.clearPlace, "P027", title + " is not a target that can be cleared",
                            "remove \"clear\"");
        }
        // A fullscreen triangle covers everything itself, unless it blends with what is there.
        const bool covers = pass.kind == PassKind::Fullscreen && !slot.blendPremultiplied;
        if (target && slot.access == SlotAccess::Write && !slot.hasClear && !slot.dontCare && !covers) {
            reporter_.error(slot.place, "P021", title + " begins an image but says not how",
                            R"(add "clear": ..., or "load": "dontCare" when every pixel is written)");
        }
        if (slot.level != none && isBufferUse(slot.use))
            reporter_.error(slot.levelPlace, "P061", title + " is " + use + ", and a buffer has no mip levels",
                            "remove it");
        if (slot.connectPlace.line == 0 && !slot.optional) {
            reporter_.error(slot.place, "P013", title + " is not connected",
                            R"(connect it, or mark it "optional": true)");
        }
    }

    void bindNames(const PassDeclaration& pass) {
        std::map<std::string, std::string> seen;
        for (const SlotDeclaration& slot : pass.slots) {
            if (slot.bind.empty()) continue;
            const auto [first, isNew] = seen.emplace(slot.bind, slot.name);
            if (!isNew) {
                reporter_.error(slot.bindPlace, "P050",
                                "slots '" + first->second + "' and '" + slot.name + "' of pass '" + pass.name +
                                    "' bind the same resource '" + slot.bind + "'");
            }
        }
    }

    void targets(const PassDeclaration& pass) {
        std::size_t colors = 0, depths = 0, sources = 0, copies = 0;
        for (const SlotDeclaration& slot : pass.slots) {
            if (slot.use == SlotUse::Color) ++colors;
            if (slot.use == SlotUse::Depth) ++depths;
            if (slot.use == SlotUse::Copy) ++(slot.access == SlotAccess::Read ? sources : copies);
        }
        if (depths > 1) reporter_.error(pass.place, "P051", "pass '" + pass.name + "' has more than one depth target");
        if (colors > 8) reporter_.error(pass.place, "P051", "pass '" + pass.name + "' has more than 8 color targets");
        if (!pass.passClass.empty()) return;
        const bool draws = pass.kind == PassKind::Raster || pass.kind == PassKind::Fullscreen;
        // Slots of an unknown template are not there to be counted; P004 says so.
        if (draws && colors + depths == 0 && !pass.slots.empty()) {
            reporter_.error(pass.place, "P052", "pass '" + pass.name + "' draws but has neither color nor depth slot");
        }
        if (pass.kind == PassKind::Copy && (sources != 1 || copies != 1)) {
            reporter_.error(pass.place, "P052",
                            "copy pass '" + pass.name + "' needs one slot that reads and one that writes");
        }
    }

    const SettingInfo* settingName(const NumberOrSetting& value) {
        if (value.setting.empty()) return nullptr;
        const SettingInfo* info = tree_.setting(value.setting);
        if (!info) {
            reporter_.error(value.place, "P041", "unknown setting '" + value.setting + "'",
                            didYouMean(value.setting, namesOf(tree_.settingInfos), "add it to \"settings\""));
        }
        return info;
    }

    // A number of pixels, views, samples: a uint setting, or an enum whose words are numbers.
    void number(const NumberOrSetting& value, const std::string& about, bool samples = false) {
        const auto good = [samples](double n) { return !samples || n == 1 || n == 2 || n == 4 || n == 8; };
        const SettingInfo* info = settingName(value);
        if (value.setting.empty()) {
            if (!good(value.number)) reporter_.error(value.place, "P043", about + " must be 1, 2, 4 or 8");
            return;
        }
        if (!info) return;
        bool fine = info->type == SettingValue::Type::Uint && !samples;
        if (info->type == SettingValue::Type::Enum) {
            fine = !info->words.empty();
            for (const std::string& each : info->words) {
                const std::optional<std::uint32_t> parsed = numberOfWord(each);
                if (!parsed || !good(*parsed)) fine = false;
            }
        }
        if (!fine) {
            reporter_.error(value.place, "P043", "setting '" + value.setting + "' cannot give " + about,
                            samples ? R"(use an enum of "1", "2", "4", "8")" : "use a uint, or an enum of numbers");
        }
    }

    void attachmentWords(const AttachmentDeclaration& attachment) {
        const std::string title = "'att." + attachment.name + "'";
        number(attachment.samples, "samples of " + title, true);
        number(attachment.size.width, "size of " + title);
        number(attachment.size.height, "size of " + title);
        number(attachment.bytes.count, "size of " + title);
        number(attachment.mipLevels, "mipLevels of " + title);
        if (attachment.size.depth) threeDimensional(attachment, title);
        if (!attachment.layersView.empty() && !tree_.view(attachment.layersView)) {
            reporter_.error(attachment.layersPlace, "P029",
                            "layers of " + title + ": unknown view '" + attachment.layersView + "'",
                            didYouMean(attachment.layersView, namesOf(tree_.views), "add it to \"views\""));
        }
        like(attachment.size, title);
        like(attachment.bytes.pixels, title);
    }

    // What a 3D image cannot have: nothing can be drawn into it, so nothing can begin its history either.
    void threeDimensional(const AttachmentDeclaration& attachment, const std::string& title) {
        number(*attachment.size.depth, "depth of " + title);
        const auto refuse = [&](Place place, const std::string& what) {
            reporter_.error(place, "P062", title + " is 3D: it has no " + what,
                            "remove it, or the \"depth\" of its size");
        };
        const bool sampled = !attachment.samples.setting.empty() || attachment.samples.number != 1;
        if (attachment.layers > 1 || !attachment.layersView.empty()) refuse(attachment.layersPlace, "layers");
        if (sampled) refuse(attachment.samples.place, "samples");
        if (attachment.history) refuse(attachment.historyPlace, "history");
        if (rhi::isDepth(attachment.formats.front())) refuse(attachment.formatPlace, "depth format");
    }

    void like(const SizeDeclaration& size, const std::string& title) {
        if (size.kind != SizeDeclaration::Kind::Like || likeTarget(size.like)) return;
        std::vector<std::string> known;
        for (const ImportDeclaration& import : tree_.imports) {
            if (import.kind != ImportDeclaration::Kind::Buffer) known.push_back("host." + import.name);
        }
        for (const AttachmentDeclaration& other : tree_.attachments) {
            if (!other.isBuffer) known.push_back("att." + other.name);
        }
        reporter_.error(size.place, "P031", "size of " + title + " follows unknown image '" + size.like + "'",
                        didYouMean(size.like, known));
    }

    bool likeTarget(const std::string& like) const {
        if (like.rfind("host.", 0) == 0) {
            const ImportDeclaration* import = tree_.import(like.substr(5));
            return import && import->kind != ImportDeclaration::Kind::Buffer;
        }
        const AttachmentDeclaration* other = like.rfind("att.", 0) == 0 ? tree_.attachment(like.substr(4)) : nullptr;
        return other && !other->isBuffer;
    }

    void sizeCircles() {
        std::set<std::string> done;
        for (const AttachmentDeclaration& start : tree_.attachments) {
            std::vector<const AttachmentDeclaration*> chain;
            const AttachmentDeclaration* at = &start;
            while (at && !done.count(at->name)) {
                done.insert(at->name);
                chain.push_back(at);
                const bool follows =
                    at->size.kind == SizeDeclaration::Kind::Like && at->size.like.rfind("att.", 0) == 0;
                at = follows ? tree_.attachment(at->size.like.substr(4)) : nullptr;
            }
            std::string circle;
            bool inside = false;
            for (const AttachmentDeclaration* each : chain) {
                inside = inside || each == at;
                if (inside) circle += "att." + each->name + " -> ";
            }
            if (!circle.empty()) {
                reporter_.error(at->size.place, "P032",
                                "sizes follow each other in a circle: " + circle + "att." + at->name,
                                "give one of them \"frame\", \"fixed\" or like a host image");
            }
        }
    }

    PassTree::Description& tree_;
    Reporter& reporter_;
};

}  // namespace

std::optional<std::uint32_t> numberOfWord(std::string_view word) {
    if (word.empty() || word.size() > 6) return std::nullopt;
    std::uint32_t value = 0;
    for (const char c : word) {
        if (c < '0' || c > '9') return std::nullopt;
        value = value * 10 + static_cast<std::uint32_t>(c - '0');
    }
    return value;
}

std::string_view word(SlotUse use) {
    static constexpr std::string_view words[] = {"color",   "depth", "sampled", "storage",
                                                 "uniform", "copy",  "vertex",  "indirect"};
    return words[static_cast<std::size_t>(use)];
}

std::string_view word(PassKind kind) {
    static constexpr std::string_view words[] = {"raster", "fullscreen", "compute", "copy"};
    return words[static_cast<std::size_t>(kind)];
}

bool fits(PassKind kind, SlotUse use) {
    const bool draws = kind == PassKind::Raster || kind == PassKind::Fullscreen;
    switch (use) {
        case SlotUse::Color:
        case SlotUse::Depth:
            return draws;
        case SlotUse::Sampled:
        case SlotUse::Storage:
        case SlotUse::Uniform:
            return kind != PassKind::Copy;
        case SlotUse::Vertex:
            return kind == PassKind::Raster;
        case SlotUse::Indirect:
            return kind == PassKind::Raster || kind == PassKind::Compute;
        case SlotUse::Copy:
            return kind == PassKind::Copy;
    }
    return false;
}

std::uint32_t levelOf(const SlotDeclaration& slot) {
    const bool one = slot.use == SlotUse::Color || slot.use == SlotUse::Depth || slot.use == SlotUse::Storage;
    return slot.level == none && one ? 0 : slot.level;
}

bool isBufferUse(SlotUse use) {
    return use == SlotUse::Uniform || use == SlotUse::Vertex || use == SlotUse::Indirect;
}

void checkDescription(PassTree::Description& description, Reporter& reporter) {
    Checker(description, reporter).run();
    checkReferences(description, reporter);
    // Warnings about what is unused would only repeat an error that made it unused.
    if (!reporter.failed()) warnUnused(description, reporter);
}

}  // namespace pelage::passes
