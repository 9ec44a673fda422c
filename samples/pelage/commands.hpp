// SPDX-License-Identifier: MIT
// The commands. Each gives the exit code and prints its own errors.
#pragma once

#include "options.hpp"

#include <string>
#include <vector>

namespace pelage::app {

struct RenderOptions {
    StageOptions stage = {};
    DeviceOptions device = {};
    std::vector<std::string> outputs = {};  // none: NAME.png
    bool report = false;
};
int render(const RenderOptions& options);

struct ViewOptions {
    StageOptions stage = {};
    DeviceOptions device = {};
    std::uint32_t frames = 0;  // end after so many; 0: when the window is closed
};
int view(const ViewOptions& options);

struct GalleryOptions {
    StageOptions stage = {};  // `input` is not used
    DeviceOptions device = {};
    std::string directory = "out";
    std::vector<std::string> only = {};    // shipped scenes; none: all
    std::vector<std::string> assets = {};  // rendered besides
};
int gallery(const GalleryOptions& options);

struct BenchOptions {
    StageOptions stage = {};
    DeviceOptions device = {};
    std::uint32_t repeat = 9;
    std::string json = {};
};
int bench(const BenchOptions& options);

int info(const std::vector<std::string>& files);
int check(const std::vector<std::string>& files);

}  // namespace pelage::app
