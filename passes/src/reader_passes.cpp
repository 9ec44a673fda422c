// SPDX-License-Identifier: MIT
// Templates, passes and their slots. A template gives kind and slots; a pass may add slots, never redefine one.
#include "reader.hpp"

#include <algorithm>

namespace pelage::passes {
namespace {

using json::Member;
using json::Value;

SlotUse useOf(const std::string& word) {
    static constexpr std::pair<std::string_view, SlotUse> uses[] = {
        {"color", SlotUse::Color},     {"depth", SlotUse::Depth},       {"sampled", SlotUse::Sampled},
        {"storage", SlotUse::Storage}, {"uniform", SlotUse::Uniform},   {"copy", SlotUse::Copy},
        {"vertex", SlotUse::Vertex},   {"indirect", SlotUse::Indirect},
    };
    for (const auto& [name, use] : uses) {
        if (name == word) return use;
    }
    return SlotUse::Color;
}

PassKind kindOf(const std::string& word) {
    if (word == "fullscreen") return PassKind::Fullscreen;
    if (word == "compute") return PassKind::Compute;
    return word == "copy" ? PassKind::Copy : PassKind::Raster;
}

void readClear(const Value& clear, SlotDeclaration& slot, Reporter& reporter) {
    slot.hasClear = true;
    slot.clearPlace = clear.place;
    if (clear.isNumber()) {
        slot.clearIsZero = true;
        return;
    }
    if (clear.isArray()) {
        if (clear.elements.size() != 4) return;
        slot.clear = {clear.elements[0].number, clear.elements[1].number, clear.elements[2].number,
                      clear.elements[3].number};
        return;
    }
    slot.clearIsDepth = true;
    const Value* depth = clear.find("depth");
    if (!depth) return;
    using Depth = SlotDeclaration::DepthClear;
    if (depth->isNumber()) {
        slot.depthClear = Depth::Number;
        slot.depthValue = static_cast<float>(std::clamp(depth->number, 0.0, 1.0));
    } else if (depth->string == "near") {
        slot.depthClear = Depth::Near;
    } else if (depth->string != "far") {
        reporter.error(depth->place, "P027", "clear depth '" + depth->string + "' is neither \"far\" nor \"near\"",
                       didYouMean(depth->string, {"far", "near"}));
    }
}

SlotDeclaration readSlot(const Member& member, Reporter& reporter) {
    const Value& value = member.value;
    SlotDeclaration slot{.name = member.key, .place = member.place};
    slot.access = accessOf(value);
    slot.use = useOf(wordOf(value, "as"));
    slot.bind = wordOf(value, "bind");
    slot.bindPlace = placeOf(value, "bind");
    slot.optional = flagOf(value, "optional", false);
    slot.levelPlace = placeOf(value, "level");
    if (const Value* level = value.find("level")) slot.level = wholeNumber(level->number, 0);
    slot.dontCare = wordOf(value, "load") == "dontCare";
    slot.blendPremultiplied = wordOf(value, "blend") == "premultiplied";
    slot.depthTestAlways = wordOf(value, "depthTest") == "always";
    if (const Value* clear = value.find("clear")) readClear(*clear, slot, reporter);
    return slot;
}

class PassReader {
public:
    PassReader(const Value& value, const Value& root, const PassTree::Description& description, Reporter& reporter)
        : value_(value), root_(root), vocabulary_(description.vocabulary()), reporter_(reporter) {}

    PassDeclaration read() {
        pass_.place = value_.place;
        pass_.name = wordOf(value_, "name");
        pass_.namePlace = placeOf(value_, "name");
        readKindAndSlots();
        readWords();
        readConditions();
        readConnections();
        forEachMember(value_, "constants", [&](const Member& member) {
            pass_.constants.push_back({member.key, numberOrSetting(member.value), member.place});
        });
        readParameters();
        if (const Value* after = value_.find("after")) {
            for (const Value& name : after->elements) pass_.after.push_back({name.string, name.place});
        }
        return std::move(pass_);
    }

private:
    std::string title() const { return "pass '" + pass_.name + "'"; }

    void readKindAndSlots() {
        const Value* kind = value_.find("kind");
        const Value* named = value_.find("template");
        const int ways = (kind ? 1 : 0) + (named ? 1 : 0) + (value_.find("class") ? 1 : 0);
        if (ways != 1) {
            reporter_.error(value_.place, "P003", title() + R"( needs exactly one of "kind", "class" and "template")");
        }
        if (named) {
            const Value* templates = root_.find("templates");
            const Value* found = templates ? templates->find(named->string) : nullptr;
            std::vector<std::string> known;
            if (templates) {
                for (const Member& member : templates->members) known.push_back(member.key);
            }
            if (!found) {
                reporter_.error(named->place, "P004", title() + ": unknown template '" + named->string + "'",
                                didYouMean(named->string, known));
            } else {
                readKind(*found);
                // What is wrong inside the template was reported where the templates were read.
                Diagnostics reported;
                Reporter quiet(std::string{}, reported);
                forEachMember(*found, "slots", [&](const Member& m) { pass_.slots.push_back(readSlot(m, quiet)); });
                for (SlotDeclaration& slot : pass_.slots) slot.place = value_.place;
            }
        }
        if (!named) readKind(value_);
        forEachMember(value_, "slots", [&](const Member& member) {
            if (pass_.slot(member.key)) {
                reporter_.error(member.place, "P008", title() + ": slot '" + member.key + "' comes from its template",
                                "give it another name, or change the template");
                return;
            }
            pass_.slots.push_back(readSlot(member, reporter_));
        });
    }

    void readKind(const Value& value) {
        pass_.kind = kindOf(wordOf(value, "kind"));
        pass_.passClass = wordOf(value, "class");
        pass_.classPlace = placeOf(value, "class");
    }

    void readParameters() {
        const Member* given = value_.member("parameters");
        if (given && pass_.passClass.empty()) {
            reporter_.error(given->place, "P054", title() + " has \"parameters\" but no class to take them",
                            R"(write "constants" for a shader, or name a "class")");
        }
        forEachMember(value_, "parameters", [&](const Member& member) {
            const Value& value = member.value;
            ParameterDeclaration made{.name = member.key, .place = value.place, .namePlace = member.place};
            using Type = ParameterInfo::Type;
            made.type = value.isString() ? Type::Word : value.isBool() ? Type::Bool : Type::Number;
            if (value.isString()) {
                made.word = value.string;
            } else {
                made.value = numberOrSetting(value);
            }
            pass_.parameters.push_back(std::move(made));
        });
    }

    void readWords() {
        pass_.view = wordOf(value_, "view");
        pass_.viewPlace = placeOf(value_, "view");
        pass_.drawList = wordOf(value_, "drawList");
        pass_.drawListPlace = placeOf(value_, "drawList");
        pass_.forEachLayer = value_.find("forEachView") != nullptr;
        pass_.enabled = flagOf(value_, "enabled", true);
        pass_.sideEffects = flagOf(value_, "sideEffects", false);
        if (const Member* sort = value_.member("sort")) {
            reporter_.warning(sort->place, "P063", title() + ": \"sort\" has no effect",
                              "remove it; the class that draws a list chooses the order in it");
        }
        readTriple("dispatch", pass_.dispatch);
        readTriple("threads", pass_.threads);
        pass_.dispatchLike = wordOf(value_, "dispatchLike");
        pass_.dispatchPlace = placeOf(value_, "dispatchLike");
        readIndirect();
        pass_.indirectPlace = placeOf(value_, "dispatchIndirect");
        const char* before = nullptr;
        for (const char* key : {"dispatch", "dispatchLike", "dispatchIndirect"}) {
            const Value* found = value_.find(key);
            if (!found) continue;
            if (before) {
                reporter_.error(found->place, "P028", title() + " has both \"" + before + "\" and \"" + key + "\"",
                                "remove one");
            }
            before = key;
        }
        if (const Member* threads = value_.member("threads"); threads && pass_.dispatchLike.empty()) {
            reporter_.error(threads->place, "P028", title() + " has \"threads\", which only \"dispatchLike\" uses",
                            "add \"dispatchLike\", or remove it");
        }
    }

    void readIndirect() {
        const Value* indirect = value_.find("dispatchIndirect");
        if (!indirect) return;
        pass_.dispatchIndirect = indirect->isString() ? indirect->string : wordOf(*indirect, "slot");
        const Value* offset = indirect->isObject() ? indirect->find("offset") : nullptr;
        if (!offset) return;
        pass_.indirectOffset = wholeNumber(offset->number, 0);
        if (pass_.indirectOffset % 4 != 0)
            reporter_.error(offset->place, "P028",
                            title() + " reads its counts at byte " + std::to_string(pass_.indirectOffset),
                            "an offset is a multiple of 4");
    }

    void readTriple(std::string_view key, std::uint32_t (&out)[3]) {
        const Value* value = value_.find(key);
        if (!value || value->elements.size() != 3) return;
        for (std::size_t i = 0; i < 3; ++i) out[i] = std::max(1U, wholeNumber(value->elements[i].number, 1));
    }

    void readConditions() {
        if (const Value* when = value_.find("enabledWhen")) {
            pass_.enabledWhen =
                Expression::parse(when->string, when->place, vocabulary_, "enabledWhen of " + title(), reporter_);
        }
        const Value* shader = value_.find("shader");
        pass_.shader.place = placeOf(value_, "shader");
        if (!shader) return;
        if (shader->isString()) {
            pass_.shader.file = shader->string;
        } else if (const Value* when = shader->find("when")) {
            pass_.shader.when =
                Expression::parse(when->string, when->place, vocabulary_, "shader of " + title(), reporter_);
            pass_.shader.file = wordOf(*shader, "then");
            pass_.shader.otherwise = wordOf(*shader, "else");
        }
    }

    SlotDeclaration* slotOf(const Member& member) {
        for (SlotDeclaration& slot : pass_.slots) {
            if (slot.name == member.key) return &slot;
        }
        reporter_.error(member.place, "P014", title() + " has no slot '" + member.key + "'",
                        didYouMean(member.key, pass_.slotNames()));
        return nullptr;
    }

    void readConnections() {
        // Without its template a pass has no slots; P004 was the fault, not each connection.
        const bool known = !(value_.find("template") && pass_.slots.empty());
        forEachMember(value_, "connect", [&](const Member& member) {
            SlotDeclaration* slot = known ? slotOf(member) : nullptr;
            if (!slot) return;
            slot->connectPlace = member.value.place;
            slot->connect = readReferences(member.value, reporter_);
        });
        forEachMember(value_, "whenDisabled", [&](const Member& member) {
            SlotDeclaration* slot = known ? slotOf(member) : nullptr;
            if (!slot) return;
            const std::vector<Reference> stand = readReferences(member.value, reporter_);
            if (!stand.empty()) slot->whenDisabled = stand.front();
        });
    }

    const Value& value_;
    const Value& root_;
    Vocabulary vocabulary_;
    Reporter& reporter_;
    PassDeclaration pass_ = {};
};

}  // namespace

void readPasses(const Value& root, PassTree::Description& description, Reporter& reporter) {
    forEachMember(root, "templates", [&](const Member& one) {
        if ((one.value.find("kind") != nullptr) == (one.value.find("class") != nullptr)) {
            reporter.error(one.value.place, "P003",
                           "template '" + one.key + R"(' needs exactly one of "kind" and "class")");
        }
        forEachMember(one.value, "slots", [&](const Member& member) { readSlot(member, reporter); });
    });
    const Value* passes = root.find("passes");
    if (!passes) return;
    for (const Value& pass : passes->elements) {
        description.passes.push_back(PassReader(pass, root, description, reporter).read());
    }
}

}  // namespace pelage::passes
