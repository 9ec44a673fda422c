// SPDX-License-Identifier: MIT
// The scattering models where they are used: as a compute shader on the device, in the arithmetic of its driver.
#pragma once

#include "failure.hpp"
#include "options.hpp"

#include <pelage/hair/scattering.hpp>

#include <span>
#include <vector>

namespace pelage::app {

struct ScatterQuery {
    hair::FiberProperties fiber = {};
    hair::FiberDirections directions = {};
};

/// One result for each query, in their order. Fails when there is no device, or its driver refuses the shader.
Result<std::vector<hair::ScatteredLobes>> scatterOnDevice(const DeviceOptions& options, hair::ScatteringModel model,
                                                          bool published, std::span<const ScatterQuery> queries);

}  // namespace pelage::app
