// SPDX-License-Identifier: MIT
// The public face: text to tree, tree to plan.
#include "link.hpp"

namespace pelage::passes {
namespace {

Result<std::shared_ptr<const PassTree::Description>> describe(Result<json::Document> document, const TextReader& reader,
                                                              const IncludePath& elsewhere, bool disk) {
    if (!document) return tl::unexpected(std::move(document.error()));
    Diagnostics out;
    const Source source = readSource(std::move(*document), reader, elsewhere, disk, out);
    std::shared_ptr<PassTree::Description> description;
    if (!out.hasErrors()) description = readDescription(source, out);
    if (!out.hasErrors()) {
        Reporter reports(source.files, out);
        checkDescription(*description, reports);
    }
    out.sortByPlace();
    if (out.hasErrors()) return tl::unexpected(std::move(out));
    resolveNames(*description);
    description->warnings = std::move(out);
    return description;
}

}  // namespace

Result<std::shared_ptr<const PassTree>> PassTree::parse(std::string_view text, const std::string& file,
                                                        const TextReader& reader) {
    auto description = describe(json::parse(text, file), reader, {}, false);
    if (!description) return tl::unexpected(std::move(description.error()));
    auto tree = std::make_shared<PassTree>();
    tree->description_ = std::move(*description);
    return tree;
}

Result<std::shared_ptr<const PassTree>> PassTree::load(const std::string& path, const IncludePath& elsewhere) {
    auto description = describe(json::parseFile(path), {}, elsewhere, true);
    if (!description) return tl::unexpected(std::move(description.error()));
    auto tree = std::make_shared<PassTree>();
    tree->description_ = std::move(*description);
    return tree;
}

const std::string& PassTree::name() const {
    return description_->name;
}
const std::string& PassTree::file() const {
    return description_->files.front();
}
const std::vector<std::string>& PassTree::files() const {
    return description_->onDisk;
}
const std::vector<SettingInfo>& PassTree::settings() const {
    return description_->settingInfos;
}
std::vector<std::string> PassTree::drawLists() const {
    return namesOf(description_->drawLists);
}
std::vector<std::string> PassTree::exports() const {
    return namesOf(description_->exports);
}
std::vector<WantedImport> PassTree::imports() const {
    std::vector<WantedImport> infos;
    for (const ImportDeclaration& import : description_->imports) {
        using Kind = ImportDeclaration::Kind;
        infos.push_back({.name = import.name,
                         .buffer = import.kind == Kind::Buffer,
                         .cube = import.kind == Kind::ImageCube,
                         .optional = import.optional,
                         .formats = import.formats,
                         .samples = import.samples});
    }
    return infos;
}
std::vector<std::string> PassTree::passClasses() const {
    std::vector<std::string> names;
    for (const PassDeclaration& pass : description_->passes) {
        if (!pass.passClass.empty() && !has(names, pass.passClass)) names.push_back(pass.passClass);
    }
    return names;
}
const Diagnostics& PassTree::warnings() const {
    return description_->warnings;
}

rhi::Extent3D levelExtent(const rhi::Extent3D& extent, bool is3D, std::uint32_t level) {
    const auto side = [level](std::uint32_t whole) { return std::max(1U, whole >> level); };
    return {side(extent.width), side(extent.height),
            is3D ? side(extent.depthOrArrayLayers) : extent.depthOrArrayLayers};
}

Result<Plan> PassTree::compile(const HostDescription& host) const {
    return link(*description_, host, {}).plan;
}

}  // namespace pelage::passes
