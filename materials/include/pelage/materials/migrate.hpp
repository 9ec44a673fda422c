// SPDX-License-Identifier: MIT
// Rewriting a material file of an older version of its type. Reading never needs it: older files keep working. It
// makes the file say what it has come to mean.
#pragma once

#include <pelage/materials/material.hpp>

namespace pelage::materials {

struct Migration {
    std::string text = {};  // the whole file: strict JSON, members in their order, comments gone
    int from = 1, to = 1;   // versions of the type
    bool isNeeded = false;  // otherwise `text` is what was given
    Diagnostics notes = {};
};

/// Renames, converts and drops what `versionUpdates` of the type say, and writes down the values that a file without a
/// parent relied on. Faults are those of Material::parse. Only this file is rewritten, not its parents.
Result<Migration> migrate(std::string_view text, const std::string& file, const Material::TypeSource& types,
                          const Material::ParentSource& parents = {});

}  // namespace pelage::materials
