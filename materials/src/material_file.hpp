// SPDX-License-Identifier: MIT
// The reader of material files; also what migrating them starts with.
#pragma once

#include <pelage/base/json.hpp>
#include <pelage/materials/material.hpp>

namespace pelage::materials {

struct MaterialReader {
    const Material::TypeSource& types;
    const Material::ParentSource& parents;
    Diagnostics diagnostics = {};
    std::vector<json::Document> chain = {};  // the file, its parent, the parent's parent, ...
    std::shared_ptr<const MaterialType> type = {};

    /// Reads everything; `chain` and `type` are kept for callers that want more than the material.
    Result<Material::Parsed> run(Result<json::Document> document);

private:
    bool add(json::Document document);
    bool findType();
    bool addParents();
    void reportCircle(std::size_t first);
    bool parentHasType(const std::string& name, json::Place place);
    void readValues(Material& material, const json::Document& document, bool hasNoParent);
    void readValue(Material& material, const json::Document& document, const json::Member& member, int version,
                   std::vector<std::pair<std::size_t, json::Place>>& seen);
    void report(Severity severity, Code code, const json::Document& document, json::Place place, std::string text,
                std::string hint = {});
};

}  // namespace pelage::materials
