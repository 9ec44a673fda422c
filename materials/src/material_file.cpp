// SPDX-License-Identifier: MIT
// Reading *.material.json, its parents first.
#include "material_file.hpp"

#include "convert.hpp"
#include "link.hpp"

#include <algorithm>
#include <filesystem>

namespace pelage::materials {
namespace {

std::string besideFile(const std::string& name, const std::string& file) {
    return (std::filesystem::path(file).parent_path() / name).string();
}

// Two ways of writing one path must not hide a circle.
std::string normal(const std::string& path) {
    return std::filesystem::path(path).lexically_normal().string();
}

}  // namespace

void MaterialReader::report(Severity severity, Code code, const json::Document& document, json::Place place,
                            std::string text, std::string hint) {
    diagnostics.add({severity, code, document.file, place.line, place.column, std::move(text), std::move(hint)});
}

Result<Material::Parsed> MaterialReader::run(Result<json::Document> document) {
    if (!document) return tl::unexpected<Diagnostics>(std::move(document.error()));
    if (!add(std::move(*document)) || !findType() || !addParents())
        return tl::unexpected<Diagnostics>(std::move(diagnostics));
    Material material(type);
    // The nearest file has the last word.
    for (auto at = chain.rbegin(); at != chain.rend(); ++at) readValues(material, *at, at == chain.rbegin());
    for (const json::Document& each : chain) material.files_.push_back(each.file);
    diagnostics.sortByPlace();
    if (diagnostics.hasErrors()) return tl::unexpected<Diagnostics>(std::move(diagnostics));
    return Material::Parsed{std::move(material), std::move(diagnostics)};
}

bool MaterialReader::add(json::Document document) {
    const Result<json::Schema> schema = json::Schema::parse(materialSchema(), "material.schema.json");
    Diagnostics found = schema ? schema->validate(document) : schema.error();
    diagnostics.append(found);
    chain.push_back(std::move(document));
    return !found.hasErrors();
}

bool MaterialReader::findType() {
    const json::Value& name = *chain.front().root.find("type");
    auto found = types ? types(name.string) : Result<std::shared_ptr<const MaterialType>>(nullptr);
    if (found && *found) {
        type = std::move(*found);
        return true;
    }
    report(Severity::Error, "V006", chain.front(), name.place, "cannot read material type '" + name.string + "'",
           "check the name; it is looked up by the program");
    if (!found) diagnostics.append(found.error());
    return false;
}

bool MaterialReader::addParents() {
    while (const json::Value* parent = chain.back().root.find("parent")) {
        const std::string path =
            parents ? parents(parent->string, chain.back().file) : besideFile(parent->string, chain.back().file);
        const auto again = std::find_if(chain.begin(), chain.end(),
                                        [&](const json::Document& each) { return normal(each.file) == normal(path); });
        if (again != chain.end()) {
            reportCircle(static_cast<std::size_t>(again - chain.begin()));
            return false;
        }
        const json::Place place = parent->place;
        const std::string name = parent->string;
        Result<json::Document> document = json::parseFile(path);
        const bool usable = document.has_value() && add(std::move(*document));
        if (!usable) {
            const json::Document& child = document ? chain[chain.size() - 2] : chain.back();
            report(Severity::Error, "V012", child, place, "cannot use parent '" + name + "'",
                   "check the name; it is looked for beside the file, by hair::Library among the presets too");
            if (!document) diagnostics.append(document.error());
            return false;
        }
        if (!parentHasType(name, place)) return false;
    }
    return true;
}

void MaterialReader::reportCircle(std::size_t first) {
    std::string names;
    for (std::size_t i = first; i < chain.size(); ++i) names += chain[i].file + " -> ";
    for (std::size_t i = first; i < chain.size(); ++i)
        report(Severity::Error, "V012", chain[i], chain[i].root.find("parent")->place,
               "parents form a circle: " + names + chain[first].file, "delete one \"parent\"");
}

bool MaterialReader::parentHasType(const std::string& name, json::Place place) {
    const json::Value& wanted = *chain.front().root.find("type");
    const json::Value& found = *chain.back().root.find("type");
    if (found.string == wanted.string) return true;
    const auto other = types(found.string);
    if (other && *other && normal((*other)->file()) == normal(type->file())) return true;
    const json::Document& child = chain[chain.size() - 2];
    report(Severity::Error, "V012", child, place,
           "parent '" + name + "' is of type '" + found.string + "', this material of '" + wanted.string + "'",
           "a parent has the type of its children");
    report(Severity::Error, "V012", chain.back(), found.place,
           "the type here is '" + found.string + "', that of '" + child.file + "' is '" + wanted.string + "'");
    return false;
}

void MaterialReader::readValues(Material& material, const json::Document& document, bool hasNoParent) {
    const MaterialType::Linked& linked = type->linked();
    const json::Value& version = *document.root.find("typeVersion");
    if (version.number > linked.version) {
        report(Severity::Error, "V001", document, version.place,
               "material was saved with type version " + shown(version.number) + ", this type is version " +
                   std::to_string(linked.version),
               "update the library, or save again");
        return;
    }
    const int saved = static_cast<int>(version.number);
    // An older file that says nothing of a property relied on the value it had then, or on its parent.
    for (const VersionStep& step : linked.versionSteps) {
        if (!hasNoParent || saved >= step.to) continue;
        for (const GivenValue& given : step.values) material.assign(given.property, given.value);
    }
    std::vector<std::pair<std::size_t, json::Place>> seen;
    for (const json::Member& member : document.root.find("values")->members)
        readValue(material, document, member, saved, seen);
}

void MaterialReader::readValue(Material& material, const json::Document& document, const json::Member& member,
                               int version, std::vector<std::pair<std::size_t, json::Place>>& seen) {
    const MaterialType::Linked& linked = type->linked();
    const Followed now = follow(linked.versionSteps, member.key, member.value, version);
    if (now.removedIn > version) {
        report(Severity::Note, "V014", document, member.place,
               "'" + member.key + "' was removed in version " + std::to_string(now.removedIn) +
                   "; its value has no effect",
               "save the material to make this permanent");
        return;
    }
    const auto index = linked.indexOf(now.name);
    if (!index) {
        report(Severity::Error, "V002", document, member.place, "material type has no property '" + member.key + "'",
               now.removedIn ? "it was removed in version " + std::to_string(now.removedIn)
                             : nameHint(member.key, propertyIds(linked.properties)));
        return;
    }
    const auto earlier = std::find_if(seen.begin(), seen.end(), [&](const auto& each) { return each.first == *index; });
    if (earlier != seen.end()) {
        report(Severity::Error, "V009", document, member.place,
               "'" + now.name + "' is given twice, once by an older name",
               "first at " + std::to_string(earlier->second.line) + ":" + std::to_string(earlier->second.column));
        return;
    }
    seen.emplace_back(*index, member.place);
    if (now.name != member.key)
        report(Severity::Note, "V007", document, member.place, "'" + member.key + "' is now '" + now.name + "'",
               "save the material to make this permanent");
    Diagnostics found;
    const Result<Value> converted = convert(linked.properties[*index], now.value, found);
    if (converted) {
        material.assign(*index, *converted);
    } else {
        found = converted.error();
    }
    for (Diagnostic each : found.items()) {
        each.file = document.file;
        each.line = member.value.place.line;
        each.column = member.value.place.column;
        diagnostics.add(std::move(each));
    }
}

Result<Material::Parsed> Material::parse(std::string_view text, const std::string& file, const TypeSource& types,
                                         const ParentSource& parents) {
    return MaterialReader{types, parents}.run(json::parse(text, file));
}

Result<Material::Parsed> Material::load(const std::string& path, const TypeSource& types, const ParentSource& parents) {
    return MaterialReader{types, parents}.run(json::parseFile(path));
}

}  // namespace pelage::materials
