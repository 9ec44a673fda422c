// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include <pelage/hair/load.hpp>

#include <cstdio>

namespace pelage::app {

int info(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
        auto asset = hair::loadAsset(file);
        if (!asset) return report(asset.error());
        std::fputs(hair::describe(*asset, file).c_str(), stdout);
    }
    return exitOk;
}

}  // namespace pelage::app
