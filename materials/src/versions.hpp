// SPDX-License-Identifier: MIT
// What became of properties between versions of a material type.
#pragma once

#include <pelage/base/json.hpp>
#include <pelage/materials/value.hpp>

#include <map>
#include <string>
#include <vector>

namespace pelage::materials {

struct VersionAction {
    enum class Kind : std::uint8_t { Rename, SetValue, Remove, Remap, RenameWords } kind = Kind::Rename;
    std::string property = {};                      // as it was called then
    std::string to = {};                            // Rename
    json::Value value = {};                         // SetValue, in the terms of the step's version
    double scale = 1, offset = 0;                   // Remap
    std::map<std::string, std::string> words = {};  // RenameWords: old to new
};

/// A setValue, followed to the present.
struct GivenValue {
    std::size_t property = 0;
    Value value = {};
    json::Value written = {};
};

struct VersionStep {
    int to = 0;
    std::vector<VersionAction> actions = {};
    std::vector<GivenValue> values = {};
};

/// A property of an older file in the terms of today.
struct Followed {
    std::string name = {};
    json::Value value = {};
    int removedIn = 0;  // the version that removed it; 0: it still exists
    bool remapped = false;
};

/// Renames of properties hold for files of every version; the others only for files older than their step. A file may
/// still state, by mistake, what its own version had removed already: then `removedIn` is not above `version`.
Followed follow(const std::vector<VersionStep>& steps, std::string name, json::Value value, int version);

}  // namespace pelage::materials
