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
    std::vector<std::string> models = {"karis", "moment_lut", "segment_cdf", "thesis", "kajiya_kay", "standard_pbr"};
    std::uint32_t repeat = 9;
    std::string json = {};
};
int bench(const BenchOptions& options);

struct ScatterOptions {
    bool exact = false;  // the truth of pelage::reference; else `model`
    std::string model = {};
    bool published = false;            // with the errors of the model's source
    std::string precision = "double";  // or float, gpu
    std::string input = "-", output = "-";
    DeviceOptions device = {};  // of gpu
    // Where `plot` names a picture, that is made instead of rows, of one fibre and view.
    std::string plot = {};
    std::string models = "karis,thesis,moment_lut";
    double eta = 1.55, betaM = 0.3, betaN = 0.3, sigmaA = 0.2;
    double alpha = -2, thetaO = 0;  // degrees
};
/// 1 when some rows were bad: they are named, and the others evaluated.
int scatter(const ScatterOptions& options);

struct AccuracyOptions {
    std::string directory = "docs";  // accuracy.md and images/scattering_*.svg
    bool quick = false;              // coarser
    bool useDevice = true;           // for the rounding of its floats
    DeviceOptions device = {};
};
int accuracy(const AccuracyOptions& options);

int info(const std::vector<std::string>& files);
int migrate(const std::vector<std::string>& files);

struct CheckOptions {
    std::vector<std::string> files = {};
    bool json = false;  // an object a line on standard output, for editors
};
/// exitOk when all files are usable, warnings or not.
int check(const CheckOptions& options);

struct GraphOptions {
    std::string input = {};                  // *.pass.json, or a shipped tree
    std::vector<std::string> outputs = {};   // .dot or .html; none: DOT to standard output
    std::string size = {};                   // of the frame
    std::vector<std::string> settings = {};  // "name=value"
    std::string measure = {};                // a scene to render with the tree; none: nothing is measured
    DeviceOptions device = {};
};
int graph(const GraphOptions& options);

struct SchemaOptions {
    std::string name = {};  // passtree or material
    bool markdown = false;  // a page for people instead
    std::string output = "-";
};
int schema(const SchemaOptions& options);

}  // namespace pelage::app
