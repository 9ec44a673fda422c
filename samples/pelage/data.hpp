// SPDX-License-Identifier: MIT
// Where the shipped files are.
#pragma once

#include <string>
#include <vector>

namespace pelage::app {

/// PELAGE_DATA of the environment, else what was installed with this program (../share/pelage from where it lies), else
/// the source directory it was built from.
std::string dataDirectory();
/// Names of the shipped scenes, sorted.
std::vector<std::string> sceneNames();
/// The file of a shipped scene; empty when there is none of that name.
std::string scenePath(const std::string& name);

}  // namespace pelage::app
