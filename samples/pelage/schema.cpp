// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "data.hpp"
#include "schema_page.hpp"
#include "text_file.hpp"

#include <cstdio>

namespace pelage::app {

namespace {

struct Kind {
    const char *name, *title;
    std::vector<std::string> schemas;  // below the data directory
    const char* example;
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"passtree",
         "Pass trees: `*.pass.json`",
         {"passes/data/passtree.schema.json"},
         "hair/data/frames/hair_frame.pass.json"},
        {"material",
         "Material types and materials: `*.materialtype.json`, `*.material.json`",
         {"materials/data/materialtype.schema.json", "materials/data/material.schema.json"},
         "hair/data/types/kajiya_kay.materialtype.json"}};
    return all;
}

Result<std::string> textOf(const Kind& kind, bool markdown) {
    const std::string data = dataDirectory() + "/";
    std::string text;
    std::vector<json::Document> documents;
    documents.reserve(kind.schemas.size());  // parts refer to them
    std::vector<SchemaPart> parts;
    for (const std::string& file : kind.schemas) {
        auto read = readTextFile(data + file);
        if (!read) return read;
        text += *read;
        auto document = json::parse(*read, file);
        if (!document) return tl::unexpected(Failure(document.error()));
        documents.push_back(std::move(*document));
        parts.push_back({.schema = documents.back()});
    }
    if (!markdown) return text;
    auto example = readTextFile(data + kind.example);
    if (!example) return example;
    parts.front().example = std::move(*example);
    parts.front().exampleFile = std::string("[") + kind.example + "](../" + kind.example + ")";
    return schemaPage(kind.title, std::string("pelage schema ") + kind.name + " --markdown", parts);
}

}  // namespace

int schema(const SchemaOptions& options) {
    for (const Kind& kind : kinds()) {
        if (options.name != kind.name) continue;
        auto text = textOf(kind, options.markdown);
        if (!text) return report(text.error());
        if (auto written = writeTextFile(options.output, *text); !written) return report(written.error());
        return exitOk;
    }
    return report(Failure("A121: there is no schema \"" + options.name + "\"; known are passtree and material"));
}

}  // namespace pelage::app
