// SPDX-License-Identifier: MIT
// Every node of the hair type and of every shipped material, and each third of the other types, is deleted and replaced
// by seven other values: reading never throws or crashes, a type that is accepted also compiles, and a refused one has
// a place for each fault.
#include "support.hpp"

#include <pelage/materials/migrate.hpp>

#include <pelage/json/value.hpp>

#include <filesystem>
#include <map>
#include <random>

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

template <class Read>
Counts fuzz(const std::string& path, int stride, const Read& read) {
    Counts counts;
    const auto document = json::parseFile(path);
    EXPECT_TRUE(document);
    if (!document) return counts;
    const std::string whole = Writer(-1, "").write(document->root);
    for (int node = 1;; node += stride) {
        bool reached = true;
        for (const std::string_view replacement : replacements) {
            Writer writer(node, replacement);
            const std::string text = writer.write(document->root);
            reached = writer.reached();
            if (!reached) break;
            if (text == whole) continue;
            ++counts.edits;
            read(text, counts);
        }
        if (!reached) return counts;
    }
}

}  // namespace

TEST(StructureFuzz, NoEditOfAShippedTypeThrowsOrCrashes) {
    const FunctorRegistry registry = hair::functorRegistry();
    Counts total;
    for (const char* name : {"hair", "kajiya_kay", "standard_pbr"}) {
        // The other types share most of their text with hair: a third of their nodes is enough.
        const int stride = std::string_view(name) == "hair" ? 1 : 3;
        const Counts counts = fuzz(typePath(name), stride, [&](const std::string& text, Counts& out) {
            const auto type = MaterialType::parse(text, "T", registry);
            if (!type) {
                ASSERT_TRUE(type.error().hasErrors());
                for (const Diagnostic& each : type.error().items()) ASSERT_GT(each.line, 0U) << toString(each);
                return;
            }
            ++out.accepted;
            out.silent += (*type)->warnings().empty() ? 1 : 0;
            Material material(*type);
            material.compile();
            for (const std::string& preset : (*type)->presets()) material.applyPreset(preset);
            material.compile();
        });
        total.edits += counts.edits;
        total.accepted += counts.accepted;
        total.silent += counts.silent;
    }
    RecordProperty("edits", total.edits);
    RecordProperty("silent", total.silent);
    std::printf("%d edits of types: %d accepted, %d of them without a warning\n", total.edits, total.accepted,
                total.silent);
    EXPECT_GT(total.edits, 4000);
    EXPECT_LT(total.silent * 4, total.edits) << "legal edits are other values in range and dropped optional keys";
}

TEST(StructureFuzz, NoEditOfAShippedMaterialThrowsOrCrashes) {
    std::map<std::string, std::shared_ptr<const MaterialType>> types;
    for (const char* name : {"hair", "kajiya_kay", "standard_pbr"})
        types[std::string(name) + ".materialtype.json"] = shipped(name);
    const Material::TypeSource source = [&](const std::string& name) {
        const auto found = types.find(name);
        return Checked<std::shared_ptr<const MaterialType>>(found == types.end() ? nullptr : found->second);
    };
    Counts total;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(PELAGE_MATERIALS) + "/presets")) {
        const Counts counts = fuzz(entry.path().string(), 1, [&](const std::string& text, Counts& out) {
            auto parsed = Material::parse(text, "I", source);
            if (!parsed) return;
            ++out.accepted;
            out.silent += parsed->warnings.empty() ? 1 : 0;
            parsed->material.compile();
            const auto migrated = migrate(text, "I", source);
            ASSERT_TRUE(migrated) << migrated.error().text();
            total.migrated += migrated->isNeeded ? 1 : 0;
            const auto again = Material::parse(migrated->text, "I", source);
            ASSERT_TRUE(again) << again.error().text() << migrated->text;
            for (const Property& property : again->material.type().properties())
                ASSERT_EQ(*again->material.get(property.id), *parsed->material.get(property.id)) << migrated->text;
        });
        total.edits += counts.edits;
        total.silent += counts.silent;
    }
    std::printf("%d edits of materials: %d without a word, %d migrated\n", total.edits, total.silent, total.migrated);
    EXPECT_GT(total.edits, 500);
    EXPECT_GT(total.migrated, 0);
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
