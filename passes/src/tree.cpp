// SPDX-License-Identifier: MIT
// The public face: text to tree, tree to plan.
#include "link.hpp"

namespace pelage::passes {
namespace {

Checked<std::shared_ptr<const PassTree::Description>> describe(const json::Document& document) {
    Checked<json::Schema> schema = json::Schema::parse(passTreeSchema(), "passtree.schema.json");
    if (!schema) return tl::unexpected(schema.error());
    Diagnostics out = schema->validate(document);
    // What breaks the schema is not looked at further: one fault, one line.
    if (out.hasErrors()) {
        out.sortByPlace();
        return tl::unexpected(std::move(out));
    }
    std::shared_ptr<PassTree::Description> description = readDescription(document, out);
    if (!out.hasErrors()) {
        Reporter reporter(document.file, out);
        checkDescription(*description, reporter);
    }
    out.sortByPlace();
    if (out.hasErrors()) return tl::unexpected(std::move(out));
    description->warnings = std::move(out);
    return description;
}

}  // namespace

Checked<std::shared_ptr<const PassTree>> PassTree::parse(std::string_view text, const std::string& file) {
    const Checked<json::Document> document = json::parse(text, file);
    if (!document) return tl::unexpected(document.error());
    auto description = describe(*document);
    if (!description) return tl::unexpected(std::move(description.error()));
    auto tree = std::make_shared<PassTree>();
    tree->description_ = std::move(*description);
    return tree;
}

Checked<std::shared_ptr<const PassTree>> PassTree::load(const std::string& path) {
    const Checked<json::Document> document = json::parseFile(path);
    if (!document) return tl::unexpected(document.error());
    auto description = describe(*document);
    if (!description) return tl::unexpected(std::move(description.error()));
    auto tree = std::make_shared<PassTree>();
    tree->description_ = std::move(*description);
    return tree;
}

const std::string& PassTree::name() const {
    return description_->name;
}
const std::string& PassTree::file() const {
    return description_->file;
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
const Diagnostics& PassTree::warnings() const {
    return description_->warnings;
}

Checked<Plan> PassTree::compile(const HostDescription& host) const {
    Diagnostics out;
    Reporter reporter(description_->file, out);
    Linker linker{.tree = *description_, .host = host, .reporter = reporter};
    linker.evaluateConditions();
    if (!out.hasErrors()) linker.resolveReferences();
    if (!out.hasErrors()) linker.schedule();
    if (!out.hasErrors()) linker.describeImages();
    out.sortByPlace();
    if (out.hasErrors()) return tl::unexpected(std::move(out));
    linker.finish();
    linker.plan.warnings = std::move(out);
    return std::move(linker.plan);
}

}  // namespace pelage::passes
