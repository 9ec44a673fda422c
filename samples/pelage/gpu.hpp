// SPDX-License-Identifier: MIT
// The device a command renders on.
#pragma once

#include "options.hpp"

#include <pelage/hair/renderer.hpp>
#include <pelage/rhi/rhi.hpp>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace pelage::app {

struct Gpu {
    rhi::Instance instance = {};
    rhi::Adapter adapter = {};
    rhi::Device device = {};
    /// Messages of the validation layer at Error level; callbacks come from any thread.
    std::shared_ptr<std::atomic<int>> validationErrors = std::make_shared<std::atomic<int>>(0);
};

/// Opens the device; `surfaceExtensions` only for windows.
Result<Gpu> openInstance(const DeviceOptions& options, std::vector<std::string> surfaceExtensions = {});
Result<void> openDevice(Gpu& gpu, const DeviceOptions& options, const rhi::Surface& surface = {});
Result<Gpu> openGpu(const DeviceOptions& options);

/// A renderer for the pass tree.
Result<hair::Renderer> makeRenderer(const Gpu& gpu, const std::shared_ptr<const passes::PassTree>& tree,
                                    bool measure = true);

/// exitOk, or a line and exitFailed when the validation layer found something.
int finish(const Gpu& gpu);

}  // namespace pelage::app
