// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "data.hpp"
#include "schema_page.hpp"
#include "text_file.hpp"

#include <pelage/materials/material.hpp>
#include <pelage/passes/tree.hpp>

#include <cstdio>

namespace pelage::app {

namespace {

struct SchemaText {
    const char* file;  // in the source tree
    std::string_view (*text)();
};

struct Kind {
    const char *name, *title;
    std::vector<SchemaText> schemas;
    const char* example;  // below the data directory
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {{"passtree",
                                           "Pass trees: `*.pass.json`",
                                           {{"passes/data/passtree.schema.json", passes::passTreeSchema}},
                                           "frames/hair_frame.pass.json"},
                                          {"material",
                                           "Material types and materials: `*.materialtype.json`, `*.material.json`",
                                           {{"materials/data/materialtype.schema.json", materials::materialTypeSchema},
                                            {"materials/data/material.schema.json", materials::materialSchema}},
                                           "types/kajiya_kay.materialtype.json"}};
    return all;
}

Result<std::string> textOf(const Kind& kind, bool markdown) {
    std::string text;
    std::vector<json::Document> documents;
    documents.reserve(kind.schemas.size());  // parts refer to them
    std::vector<SchemaPart> parts;
    for (const SchemaText& schema : kind.schemas) {
        text += schema.text();
        auto document = json::parse(schema.text(), schema.file);
        if (!document) return tl::unexpected(document.error());
        documents.push_back(std::move(*document));
        parts.push_back({.schema = documents.back()});
    }
    if (!markdown) return text;
    auto example = readTextFile(dataDirectory() + "/" + kind.example);
    if (!example) return example;
    const std::string file = std::string("hair/data/") + kind.example;
    parts.front().example = std::move(*example);
    parts.front().exampleFile = "[" + file + "](../" + file + ")";
    return schemaPage(kind.title, std::string("pelage schema ") + kind.name + " --markdown", parts);
}

/// docs/diagnostics.md: every code of the list in base, by family.
std::string diagnosticsPage() {
    std::string page =
        "# Diagnostics\n\nMade by `pelage schema diagnostics` from "
        "[base/include/pelage/base/codes.def](../base/include/pelage/base/codes.def).\n\n"
        "Every fault is one line: `file:line:column: error CODE: what was found, what was expected; while validating "
        "what; hint: what to do`.\nEach code has one meaning and keeps it; a fault keeps its code and its place on its "
        "way up. A fault of a device also has a\nkind: validation, out of memory, device lost, unsupported or "
        "internal.\n";
    const auto family = [&](char letter, std::string_view who) {
        page += "\n## " + std::string(1, letter) + ": " + std::string(who) + "\n\n| code | meaning |\n|---|---|\n";
    };
    const auto row = [&](std::string_view code, std::string_view name, std::string_view meaning) {
        page += "| " + std::string(code) + (name.empty() ? "" : " `" + std::string(name) + "`") + " | " +
                std::string(meaning) + " |\n";
    };
#define PELAGE_CODE_FAMILY(letter, who) family(#letter[0], who);
#define PELAGE_CODE(code, meaning) row(#code, "", meaning);
#define PELAGE_RHI_CODE(code, name, meaning) row(#code, #name, meaning);
#include <pelage/base/codes.def>
    return page;
}

}  // namespace

int schema(const SchemaOptions& options) {
    if (options.name == "diagnostics") {
        if (auto written = writeTextFile(options.output, diagnosticsPage()); !written) return report(written.error());
        return exitOk;
    }
    for (const Kind& kind : kinds()) {
        if (options.name != kind.name) continue;
        auto text = textOf(kind, options.markdown);
        if (!text) return report(text.error());
        if (auto written = writeTextFile(options.output, *text); !written) return report(written.error());
        return exitOk;
    }
    return report(
        failure("A121", "there is no schema \"" + options.name + "\"; known are passtree, material and diagnostics"));
}

}  // namespace pelage::app
