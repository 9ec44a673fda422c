// SPDX-License-Identifier: MIT
// The page docs/accuracy.md: words and goals from here, every figure measured.
#pragma once

#include "accuracy_measure.hpp"

#include <map>

namespace pelage::app {

struct AroundResult {
    ModelForm form = {};
    double betaN = 0, sigma = 0;
    LobeDistance distance = {};
};
struct SphereResult {
    ModelForm form = {};
    std::vector<double> bySigma = {};
};
struct FurnaceResult {
    ModelForm form = {};
    std::vector<double> byTheta = {};
};
struct ReciprocityResult {
    ModelForm form = {};
    double error = 0;
};
struct CostResult {
    ModelForm form = {};
    std::uint32_t instructions = 0;
};
struct PlotResult {
    std::string file = {}, words = {};  // under images/
};

struct AccuracyResult {
    std::string command = {}, device = {};  // device: empty when none was used
    std::vector<AroundResult> around = {};
    std::vector<double> sigmas = {};  // of the sphere
    std::vector<SphereResult> sphere = {};
    std::vector<double> thetas = {};  // of the furnace, degrees
    std::vector<FurnaceResult> furnace = {};
    std::vector<RoundingResult> rounding = {};
    std::vector<HalfResult> halves = {};
    std::vector<ReciprocityResult> reciprocity = {};
    std::vector<CostResult> costs = {};
    std::vector<PlotResult> plots = {};
};

std::string accuracyPage(const AccuracyResult& result);

}  // namespace pelage::app
