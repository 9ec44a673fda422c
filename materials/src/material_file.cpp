// SPDX-License-Identifier: MIT
// Reading *.material.json.
#include "convert.hpp"
#include "link.hpp"
#include "schemas.hpp"

#include <algorithm>

namespace pelage::materials {

struct MaterialReader {
    const json::Document& document;
    const Material::TypeSource& types;
    Diagnostics diagnostics = {};

    void report(Severity severity, std::string code, json::Place place, std::string text, std::string hint = {}) {
        diagnostics.add(
            {severity, std::move(code), document.file, place.line, place.column, std::move(text), std::move(hint)});
    }

    Checked<Material::Parsed> run() {
        const Checked<json::Schema> schema = json::Schema::parse(materialSchema(), "material.schema.json");
        if (!schema) return tl::unexpected<Diagnostics>(schema.error());
        diagnostics = schema->validate(document);
        if (diagnostics.hasErrors()) return tl::unexpected<Diagnostics>(std::move(diagnostics));
        const json::Value& typeName = *document.root.find("type");
        Checked<std::shared_ptr<const MaterialType>> type =
            types ? types(typeName.string) : Checked<std::shared_ptr<const MaterialType>>(nullptr);
        if (!type || !*type) {
            report(Severity::Error, "V006", typeName.place, "cannot read material type '" + typeName.string + "'",
                   "check the name; it is looked up by the program");
            if (!type) diagnostics.append(type.error());
            return tl::unexpected<Diagnostics>(std::move(diagnostics));
        }
        Material material(std::move(*type));
        read(material);
        diagnostics.sortByPlace();
        if (diagnostics.hasErrors()) return tl::unexpected<Diagnostics>(std::move(diagnostics));
        return Material::Parsed{std::move(material), std::move(diagnostics)};
    }

    void read(Material& material) {
        const MaterialType::Linked& linked = material.type().linked();
        const json::Value& version = *document.root.find("typeVersion");
        if (version.number > linked.version) {
            report(Severity::Error, "V001", version.place,
                   "material was saved with type version " + shown(version.number) + ", this type is version " +
                       std::to_string(linked.version),
                   "update the library, or save again");
            return;
        }
        // An older file that says nothing of a property relied on the value it had then.
        for (const VersionStep& step : linked.versionSteps) {
            if (version.number >= step.to) continue;
            for (const auto& [property, value] : step.values) material.set(linked.properties[property].id, value);
        }
        std::vector<std::pair<std::size_t, json::Place>> seen;
        for (const json::Member& member : document.root.find("values")->members) readValue(material, member, seen);
    }

    void readValue(Material& material, const json::Member& member,
                   std::vector<std::pair<std::size_t, json::Place>>& seen) {
        const MaterialType::Linked& linked = material.type().linked();
        const std::string id = linked.currentName(member.key);
        const auto index = linked.indexOf(id);
        if (!index) {
            report(Severity::Error, "V002", member.place, "material type has no property '" + member.key + "'",
                   nameHint(member.key, propertyIds(linked.properties)));
            return;
        }
        const auto earlier =
            std::find_if(seen.begin(), seen.end(), [&](const auto& each) { return each.first == *index; });
        if (earlier != seen.end()) {
            report(Severity::Error, "V009", member.place, "'" + id + "' is given twice, once by an older name",
                   "first at " + std::to_string(earlier->second.line) + ":" + std::to_string(earlier->second.column));
            return;
        }
        seen.emplace_back(*index, member.place);
        if (id != member.key)
            report(Severity::Note, "V007", member.place, "'" + member.key + "' is now '" + id + "'",
                   "save the material to make this permanent");
        Conversion converted = convert(linked.properties[*index], member.value);
        if (converted.value) material.set(id, *converted.value);
        if (!converted.problem) return;
        converted.problem->file = document.file;
        converted.problem->line = member.value.place.line;
        converted.problem->column = member.value.place.column;
        diagnostics.add(std::move(*converted.problem));
    }
};

Checked<Material::Parsed> Material::parse(std::string_view text, const std::string& file, const TypeSource& types) {
    const Checked<json::Document> document = json::parse(text, file);
    if (!document) return tl::unexpected<Diagnostics>(document.error());
    return MaterialReader{*document, types}.run();
}

Checked<Material::Parsed> Material::load(const std::string& path, const TypeSource& types) {
    const Checked<json::Document> document = json::parseFile(path);
    if (!document) return tl::unexpected<Diagnostics>(document.error());
    return MaterialReader{*document, types}.run();
}

}  // namespace pelage::materials
