// SPDX-License-Identifier: MIT
// The kinds of passes that the graph records itself: fullscreen, compute and copy, recorded like any class of a host.
#pragma once

#include <pelage/passes/pass_class.hpp>

namespace pelage::passes {

constexpr std::uint32_t slotSet = 1;  // the set in which the slots of a pass are bound

/// One triangle over the targets.
PassRecorder fullscreenPass(rhi::RenderPipeline pipeline);
/// As many workgroups as the pass says, or as the buffer of its indirect slot says.
PassRecorder computePass(rhi::ComputePipeline pipeline);
/// What is read into what is written: all levels of an image or those that the slots name, or a whole buffer.
PassRecorder copyPass();

}  // namespace pelage::passes
