// SPDX-License-Identifier: MIT
// Every node of every shipped type and material is deleted and replaced by seven other values: reading never throws or
// crashes, a type that is accepted also compiles, a refused one has a place for each fault, and what is accepted
// without a word is one of a list of edits that are legal.
#include "support.hpp"

#include <pelage/materials/migrate.hpp>

#include <pelage/base/json.hpp>

#include <filesystem>
#include <map>
#include <random>
#include <set>

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

namespace {

std::string quote(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

// `index` counts nodes in order; the one it reaches is written as `replacement`, or left out when that is empty.
class Writer {
public:
    Writer(int target, std::string_view replacement) : left_(target), replacement_(replacement) {}

    std::string write(const json::Value& value) {
        if (left_-- == 0) return std::string(replacement_);
        std::string out;
        switch (value.kind) {
            case json::Kind::Null:
                return "null";
            case json::Kind::Bool:
                return value.boolean ? "true" : "false";
            case json::Kind::Number:
                return number(value);
            case json::Kind::String:
                return quote(value.string);
            case json::Kind::Array:
                for (const json::Value& element : value.elements) append(out, "", write(element));
                return "[" + out + "]";
            case json::Kind::Object:
                for (const json::Member& member : value.members)
                    append(out, quote(member.key) + ":", write(member.value));
                return "{" + out + "}";
        }
        return out;
    }
    bool reached() const { return left_ < 0; }

private:
    static std::string number(const json::Value& value) {
        std::ostringstream out;
        out.precision(17);
        if (value.isInteger) {
            out << static_cast<long long>(value.number);
        } else {
            out << value.number;
        }
        const std::string text = out.str();
        return value.isInteger || text.find_first_of(".e") != std::string::npos ? text : text + ".0";
    }
    static void append(std::string& out, const std::string& key, const std::string& text) {
        if (text.empty()) return;  // deleted
        if (!out.empty()) out += ",\n";
        out += key + text;
    }

    int left_;
    std::string_view replacement_;
};

struct Counts {
    int edits = 0, accepted = 0, silent = 0, migrated = 0;
};

constexpr std::string_view replacements[] = {"", "null", "[]", "{}", "\"x\"", "1", "-1.5", "true"};

// Where each node stands, in the order of Writer, with * for names that the file gives and # for places in a list:
// "groups.#.properties.#.min".
void placesOf(const json::Value& value, const std::string& place, bool names, std::vector<std::string>& places) {
    static const std::set<std::string> named = {"inputs", "options", "shaders", "presets", "values", "in", "out"};
    places.push_back(place);
    const std::string before = place.empty() ? "" : place + ".";
    for (const json::Value& element : value.elements) placesOf(element, before + "#", false, places);
    for (const json::Member& member : value.members) {
        // A preset is an object of values, a level below its name.
        const bool preset = names && place == "presets";
        placesOf(member.value, before + (names ? "*" : member.key), preset || (!names && named.count(member.key) != 0),
                 places);
    }
}

using Silent = std::set<std::string>;

/// `read` gives true for a text that is taken without a word.
template <class Read>
Counts fuzz(const std::string& path, Silent& silent, const Read& read) {
    Counts counts;
    const auto document = json::parseFile(path);
    EXPECT_TRUE(document);
    if (!document) return counts;
    const std::string whole = Writer(-1, "").write(document->root);
    std::vector<std::string> places;
    placesOf(document->root, "", false, places);
    for (std::size_t node = 1; node < places.size(); ++node) {
        for (const std::string_view replacement : replacements) {
            Writer writer(static_cast<int>(node), replacement);
            const std::string text = writer.write(document->root);
            EXPECT_TRUE(writer.reached());
            if (text == whole) continue;  // it says that already
            ++counts.edits;
            if (!read(text, counts)) continue;
            ++counts.silent;
            silent.insert(places[node] + " " + (replacement.empty() ? "deleted" : std::string(replacement)));
        }
    }
    return counts;
}

// Edits that are taken without a word, and why that is right.
struct Legal {
    const char* place;
    std::vector<const char*> edits;
    const char* why;
};

void expectOnly(const std::vector<Legal>& all, const Silent& silent) {
    Silent legal;
    for (const Legal& each : all) {
        for (const char* edit : each.edits) legal.insert(std::string(each.place) + " " + edit);
    }
    for (const std::string& each : silent) EXPECT_EQ(legal.count(each), 1U) << "taken without a word: " << each;
    for (const std::string& each : legal) EXPECT_EQ(silent.count(each), 1U) << "no longer taken silently: " << each;
}

const std::vector<Legal> legalInTypes = {
    {"$schema", {"\"x\"", "deleted"}, "for editors"},
    {"description", {"\"x\"", "deleted"}, "for people"},
    {"functors.#.id", {"\"x\""}, "another name"},
    {"functors.#.out.*", {"deleted"}, "what it drove has a default or another driver"},
    {"groups.#.label", {"\"x\"", "deleted"}, "for people; the name when absent"},
    {"groups.#.name", {"\"x\""}, "another name, of properties that nothing else names"},
    {"groups.#.properties.#", {"deleted"}, "nothing needs it: what it drove has a default"},
    {"groups.#.properties.#.default", {"\"x\"", "-1.5", "1"}, "another value in range, or of a texture another file"},
    {"groups.#.properties.#.default.#", {"-1.5", "1"}, "another component in range; vectors without a range take any"},
    {"groups.#.properties.#.description", {"\"x\"", "deleted"}, "for people"},
    {"groups.#.properties.#.enabledWhen", {"deleted"}, "always enabled"},
    {"groups.#.properties.#.label", {"\"x\"", "deleted"}, "for people; the name when absent"},
    {"groups.#.properties.#.max", {"1", "deleted"}, "another range around the default, or none"},
    {"groups.#.properties.#.min", {"-1.5", "1", "deleted"}, "another range around the default, or none"},
    {"groups.#.properties.#.name", {"\"x\""}, "another name, that nothing else says"},
    {"groups.#.properties.#.softMax", {"-1.5", "1", "deleted"}, "another slider within the range"},
    {"groups.#.properties.#.softMin", {"-1.5", "1", "deleted"}, "another slider within the range"},
    {"groups.#.properties.#.step", {"1", "deleted"}, "another slider"},
    {"groups.#.properties.#.unit", {"deleted"}, "a number without a unit"},
    {"groups.#.properties.#.visibleWhen", {"deleted"}, "always visible"},
    {"name", {"\"x\""}, "another name"},
    {"options.*.max", {"1"}, "another range around the default"},
    {"presets", {"deleted", "{}"}, "no presets"},
    {"presets.*", {"deleted", "{}"}, "an empty preset, or none"},
    {"presets.*.*", {"-1.5", "1", "deleted", "true"}, "another value in range, or the default"},
    {"shaders.*.drawList", {"\"x\""}, "only the tree knows its lists (M017)"},
    {"shaders.*.enabled", {"deleted", "true"}, "true when absent"},
    {"shaders.*.fragment", {"\"x\"", "deleted"}, "only the host knows its shaders; none writes depth only"},
    {"shaders.*.options", {"[]", "deleted"}, "only the shader knows what it reads (S020)"},
    {"shaders.*.options.#", {"deleted"}, "only the shader knows what it reads (S020)"},
    {"shaders.*.state", {"deleted", "{}"}, "the defaults"},
    {"shaders.*.state.blend", {"deleted"}, "the default"},
    {"shaders.*.state.cull", {"deleted"}, "the default"},
    {"shaders.*.state.depthTest", {"deleted"}, "the default"},
    {"shaders.*.state.depthWrite", {"deleted", "true"}, "the default, or the other value"},
    {"shaders.*.vertex", {"\"x\""}, "only the host knows its shaders"},
    {"versionUpdates", {"[]", "deleted"}, "nothing is done to older materials"},
    {"versionUpdates.#", {"deleted"}, "less is done to older materials"},
    {"versionUpdates.#.actions.#", {"deleted"}, "less is done to older materials"},
};

const std::vector<Legal> legalInMaterials = {
    {"$schema", {"\"x\"", "deleted"}, "for editors"},
    {"description", {"\"x\"", "deleted"}, "for people"},
    {"typeVersion", {"1"}, "a version that there was"},
    {"values", {"{}"}, "all defaults"},
    {"values.*", {"1", "deleted"}, "another value in range, or the default"},
    {"values.*.#", {"1"}, "another component in range"},
};

}  // namespace

TEST(StructureFuzz, NoEditOfAShippedTypeThrowsOrCrashes) {
    const FunctorRegistry registry = hair::functorRegistry();
    Counts total;
    Silent silent;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PELAGE_MATERIALS) + "/types")) {
        if (!entry.path().string().ends_with(".materialtype.json")) continue;
        const Counts counts = fuzz(entry.path().string(), silent, [&](const std::string& text, Counts& out) {
            const auto type = MaterialType::parse(text, "T", registry);
            if (!type) {
                EXPECT_TRUE(type.error().hasErrors());
                for (const Diagnostic& each : type.error().items()) EXPECT_GT(each.line, 0U) << toString(each);
                return false;
            }
            ++out.accepted;
            Material material(*type);
            material.compile();
            for (const std::string& preset : (*type)->presets()) material.applyPreset(preset);
            material.compile();
            return (*type)->warnings().empty();
        });
        total.edits += counts.edits;
        total.accepted += counts.accepted;
        total.silent += counts.silent;
    }
    std::printf("%d edits of types: %d accepted, %d of them without a warning\n", total.edits, total.accepted,
                total.silent);
    EXPECT_GT(total.edits, 9000);
    expectOnly(legalInTypes, silent);
}

TEST(StructureFuzz, NoEditOfAShippedMaterialThrowsOrCrashes) {
    std::map<std::string, std::shared_ptr<const MaterialType>> types;
    for (const char* name : {"hair", "kajiya_kay", "standard_pbr"})
        types[std::string(name) + ".materialtype.json"] = shipped(name);
    const Material::TypeSource source = [&](const std::string& name) {
        const auto found = types.find(name);
        return Result<std::shared_ptr<const MaterialType>>(found == types.end() ? nullptr : found->second);
    };
    Counts total;
    Silent silent;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PELAGE_MATERIALS) + "/presets")) {
        const Counts counts = fuzz(entry.path().string(), silent, [&](const std::string& text, Counts& out) {
            auto parsed = Material::parse(text, "I", source);
            if (!parsed) return false;
            ++out.accepted;
            parsed->material.compile();
            const auto migrated = migrate(text, "I", source);
            EXPECT_TRUE(migrated) << migrated.error().text();
            if (!migrated) return false;
            total.migrated += migrated->isNeeded ? 1 : 0;
            const auto again = Material::parse(migrated->text, "I", source);
            EXPECT_TRUE(again) << again.error().text() << migrated->text;
            if (!again) return false;
            for (const Property& property : again->material.type().properties())
                EXPECT_EQ(*again->material.get(property.id), *parsed->material.get(property.id)) << migrated->text;
            return parsed->warnings.empty();
        });
        total.edits += counts.edits;
        total.silent += counts.silent;
    }
    std::printf("%d edits of materials: %d without a word, %d migrated\n", total.edits, total.silent, total.migrated);
    EXPECT_GT(total.edits, 500);
    EXPECT_GT(total.migrated, 0);
    expectOnly(legalInMaterials, silent);
}

TEST(StructureFuzz, DamagedBytesOfATypeNeverThrowOrCrash) {
    const FunctorRegistry registry = hair::functorRegistry();
    const std::string original = readFile(typePath("hair"));
    std::mt19937 random(11);
    for (int round = 0; round < 400; ++round) {
        std::string text = original;
        for (int edit = 0; edit < 2; ++edit) {
            const std::size_t at = random() % text.size();
            if (random() % 2 == 0) {
                text[at] = static_cast<char>(random());
            } else {
                // Swapping two words keeps the syntax and breaks the meaning, which is where the linker works.
                const std::size_t other = text.find('"', random() % text.size());
                if (other != std::string::npos && at + 4 < text.size() && other + 4 < text.size()) {
                    for (std::size_t i = 1; i < 4; ++i) std::swap(text[at + i], text[other + i]);
                }
            }
        }
        const auto type = MaterialType::parse(text, "T", registry);
        if (type) Material(*type).compile();
    }
}
