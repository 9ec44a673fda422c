// SPDX-License-Identifier: MIT
#pragma once

#include <pelage/base/json.hpp>

#include <string>
#include <vector>

namespace pelage::app {

struct SchemaPart {
    std::string title = {};  // of the section; empty: the schema's own title
    const json::Document& schema;
    std::string example = {}, exampleFile = {};  // a whole file
};

/// A page in Markdown about a kind of file: every member of its schema with type, range, default, description and code.
std::string schemaPage(const std::string& title, const std::string& command, const std::vector<SchemaPart>& parts);

}  // namespace pelage::app
