// SPDX-License-Identifier: MIT
#include "linker.hpp"
#include "schemas.hpp"

#include <algorithm>

namespace pelage::materials {
namespace {

using Parsed = Result<std::shared_ptr<const MaterialType>>;

// Phase A; errors end it, so that one mistake is not reported as ten.
Result<TypeDescription> readDescription(const json::Document& document) {
    const Result<json::Schema> schema = json::Schema::parse(materialTypeSchema(), "materialtype.schema.json");
    if (!schema) return tl::unexpected<Diagnostics>(schema.error());
    Diagnostics faults = schema->validate(document);
    if (faults.hasErrors()) return tl::unexpected<Diagnostics>(std::move(faults));
    return describe(document);
}

}  // namespace

// `make` keeps MaterialType's only constructor private to this file.
struct MaterialTypeReader {
    static Parsed make(const Result<json::Document>& document, const FunctorRegistry& registry) {
        if (!document) return tl::unexpected<Diagnostics>(document.error());
        const Result<TypeDescription> description = readDescription(*document);
        if (!description) return tl::unexpected<Diagnostics>(description.error());
        Linker linker(*description, registry);
        MaterialType::Linked linked = linker.run();
        if (linker.diagnostics().hasErrors()) return tl::unexpected<Diagnostics>(std::move(linker.diagnostics()));
        linked.warnings = std::move(linker.diagnostics());
        auto type = std::make_shared<MaterialType>();
        type->linked_ = std::make_shared<const MaterialType::Linked>(std::move(linked));
        return std::shared_ptr<const MaterialType>(std::move(type));
    }
};

Parsed MaterialType::parse(std::string_view text, const std::string& file, const FunctorRegistry& registry) {
    return MaterialTypeReader::make(json::parse(text, file), registry);
}

Parsed MaterialType::load(const std::string& path, const FunctorRegistry& registry) {
    return MaterialTypeReader::make(json::parseFile(path), registry);
}

const std::string& MaterialType::name() const {
    return linked_->name;
}
const std::string& MaterialType::file() const {
    return linked_->file;
}
int MaterialType::version() const {
    return linked_->version;
}
const std::vector<Property>& MaterialType::properties() const {
    return linked_->properties;
}
const std::vector<Input>& MaterialType::inputs() const {
    return linked_->inputs;
}
const std::vector<Option>& MaterialType::options() const {
    return linked_->options;
}
const std::vector<ShaderUse>& MaterialType::shaders() const {
    return linked_->shaders;
}
const std::vector<std::string>& MaterialType::presets() const {
    return linked_->presetNames;
}
Diagnostics MaterialType::unknownDrawLists(const std::vector<std::string>& known) const {
    Diagnostics out;
    for (std::size_t i = 0; i < linked_->shaders.size(); ++i) {
        const ShaderUse& shader = linked_->shaders[i];
        if (std::find(known.begin(), known.end(), shader.drawList) != known.end()) continue;
        const json::Place place = linked_->drawListPlaces[i];
        out.add({Severity::Warning, "M017", linked_->file, place.line, place.column,
                 "shader " + quoted(shader.name) + ": the pass tree has no draw list " + quoted(shader.drawList) +
                     "; nothing draws it",
                 nameHint(shader.drawList, known)});
    }
    return out;
}
const Diagnostics& MaterialType::warnings() const {
    return linked_->warnings;
}

const Property* MaterialType::find(std::string_view id) const {
    const auto index = linked_->indexOf(id);
    return index ? &linked_->properties[*index] : nullptr;
}

}  // namespace pelage::materials
