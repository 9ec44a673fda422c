// SPDX-License-Identifier: MIT
// What a benchmark found, and how it is written down.
#pragma once

#include "failure.hpp"

#include <pelage/hair/renderer.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace pelage::app {

struct PassResult {
    std::string name = {};
    double milliseconds = 0;  // median
    std::uint64_t fragments = 0;
};

struct ModelResult {
    std::string name = {}, material = {};
    double milliseconds = 0;  // median of the frame
    std::vector<PassResult> passes = {};
    std::vector<hair::AttachmentReport> attachments = {};
};

/// Instructions of a model's forward shader with the options of its defaults but one.
struct InstructionResult {
    std::string model = {}, shader = {};
    std::string variant = {};  // "as authored", or "lobeTT off"
    std::uint32_t instructions = 0;
};

struct BenchResult {
    std::string scene = {}, device = {}, driver = {};
    std::uint32_t width = 0, height = 0, repeats = 0;
    std::string yardstick = {};  // the model that is 1.00
    std::vector<ModelResult> models = {};
    std::vector<InstructionResult> instructions = {};
};

/// Counts the forward shader of a material as it is, and with each component that is on switched off.
Result<void> countOptions(const std::string& model, materials::Material& material,
                          std::vector<InstructionResult>& results);

std::string benchText(const BenchResult& result);
/// Through a temporary name, like every file this program writes.
Result<void> writeBenchJson(const std::string& path, const BenchResult& result);

}  // namespace pelage::app
