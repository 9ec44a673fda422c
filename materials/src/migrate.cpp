// SPDX-License-Identifier: MIT
#include "convert.hpp"
#include "link.hpp"
#include "material_file.hpp"

#include <pelage/materials/migrate.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::materials {
namespace {

std::string stringText(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20) {
            const auto byte = static_cast<unsigned char>(c);
            out += std::string("\\u00") + hex[byte >> 4] + hex[byte & 15];
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string valueText(const json::Value& value) {
    switch (value.kind) {
        case json::Kind::Bool:
            return value.boolean ? "true" : "false";
        case json::Kind::Number:
            // Whole numbers may need more digits than a float has.
            if (value.isInteger && std::abs(value.number) < 9e15)
                return std::to_string(static_cast<std::int64_t>(value.number));
            return shown(value.number);
        case json::Kind::String:
            return stringText(value.string);
        case json::Kind::Array: {
            std::string out;
            for (const json::Value& element : value.elements) out += (out.empty() ? "" : ", ") + valueText(element);
            return "[" + out + "]";
        }
        default:
            return "null";  // the schema of materials has no other kinds
    }
}

// The values of the file by the names and in the numbers of today, then those it relied on without saying so.
std::string valuesText(const json::Document& document, const MaterialType::Linked& linked, int version) {
    std::vector<std::pair<std::string, std::string>> rows;
    for (const json::Member& member : document.root.find("values")->members) {
        const Followed now = follow(linked.versionSteps, member.key, member.value, version);
        if (now.removedIn == 0) rows.emplace_back(now.name, valueText(now.value));
    }
    const bool hasParent = document.root.find("parent") != nullptr;
    const std::size_t stated = rows.size();
    for (const VersionStep& step : linked.versionSteps) {
        if (hasParent || version >= step.to) continue;
        for (const GivenValue& given : step.values) {
            const std::string& id = linked.properties[given.property].id;
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return each.first == id; });
            if (row == rows.end()) {
                rows.emplace_back(id, valueText(given.written));
            } else if (static_cast<std::size_t>(row - rows.begin()) >= stated) {
                row->second = valueText(given.written);  // a later step gave it again
            }
        }
    }
    std::string out;
    for (const auto& [id, text] : rows)
        out += (out.empty() ? "\n" : ",\n") + std::string("        \"") + id + "\": " + text;
    return rows.empty() ? "{}" : "{" + out + "\n    }";
}

}  // namespace

Result<Migration> migrate(std::string_view text, const std::string& file, const Material::TypeSource& types,
                          const Material::ParentSource& parents) {
    MaterialReader reader{types, parents};
    Result<Material::Parsed> parsed = reader.run(json::parse(text, file));
    if (!parsed) return tl::unexpected<Diagnostics>(std::move(parsed.error()));
    const json::Document& document = reader.chain.front();
    const MaterialType::Linked& linked = reader.type->linked();
    Migration out;
    out.from = static_cast<int>(document.root.find("typeVersion")->number);
    out.to = linked.version;
    out.notes = std::move(parsed->warnings);
    // A file of today may still use a name from before.
    out.isNeeded = out.from < out.to;
    for (const json::Member& member : document.root.find("values")->members)
        out.isNeeded |= follow(linked.versionSteps, member.key, member.value, out.from).name != member.key;
    if (!out.isNeeded) {
        out.text = std::string(text);
        return out;
    }
    std::string body;
    for (const json::Member& member : document.root.members) {
        const std::string value = member.key == "typeVersion" ? std::to_string(out.to)
                                  : member.key == "values"    ? valuesText(document, linked, out.from)
                                                              : valueText(member.value);
        body += (body.empty() ? "\n    " : ",\n    ") + stringText(member.key) + ": " + value;
    }
    out.text = "{" + body + "\n}\n";
    return out;
}

}  // namespace pelage::materials
