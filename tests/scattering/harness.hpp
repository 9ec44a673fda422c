// SPDX-License-Identifier: MIT
// Runs the compute shaders of this folder: materials and a moment table in, a few numbers out.
#pragma once

#include "gpu.hpp"
#include "scattering/packed.hpp"

#include <pelage/hair/scattering.hpp>

#include <random>

namespace pelage::test {

/// What stress.comp found.
struct Found {
    std::uint32_t notFinite, negative, guardFailed;
    float worstPeak, worstStep;
    std::uint32_t worstSeed;
    float worstTurn, worstMirror, worstTurnRelative;
};

/// View of furnace.comp.
struct FurnaceView {
    float sinO, cosO, h, unused;
};
inline constexpr std::uint32_t furnaceSteps = 96;

/// A fibre anywhere in the ranges of FiberProperties, often at their ends.
hair::FiberProperties anyFiber(std::mt19937& random);

class ScatteringHarness : public GpuTest {
protected:
    struct StressRun {
        hair::ScatteringModel model = {};
        bool published = false, nonsense = false, nearField = false;
        std::uint32_t invocations = 0, points = 64, seed = 1;
    };
    Found stress(const StressRun& run, const std::vector<hair::PackedFiber>& materials, hair::MomentTable* table);
    /// The share of white light that each view receives; materials take turns.
    std::vector<float> furnace(hair::ScatteringModel model, bool published, bool nearField,
                               const std::vector<hair::PackedFiber>& materials, const std::vector<FurnaceView>& views,
                               hair::MomentTable* table);

    /// The table as a texture; zeros for null.
    rhi::TextureView upload(hair::MomentTable* table);

private:
    rhi::ComputePipeline pipelineOf(const char* shader, std::vector<rhi::ConstantEntry> constants);
};

}  // namespace pelage::test
