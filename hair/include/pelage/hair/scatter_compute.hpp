// SPDX-License-Identifier: MIT
// The scattering models on the device, row by row: the same shaders' source as the renderer's, in the arithmetic of the
// driver at hand. For measuring, not for rendering.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/hair/scattering.hpp>
#include <pelage/rhi/rhi.hpp>

#include <vector>

namespace pelage::hair {

struct ScatterRow {
    FiberProperties fiber = {};
    FiberDirections directions = {};
};

class ScatterCompute {
public:
    explicit ScatterCompute(rhi::Device device) : device_(std::move(device)) {}

    /// One result for each row, in their order; waits for the device. Tables are made for the rows that need them.
    Result<std::vector<ScatteredLobes>> evaluate(ScatteringModel model, bool published,
                                                 std::span<const ScatterRow> rows);

private:
    rhi::Device device_;
};

}  // namespace pelage::hair
