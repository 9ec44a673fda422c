// SPDX-License-Identifier: MIT
// Words for the parts of a plan, as the graph and the page show them.
#pragma once

#include <pelage/passes/tree.hpp>

#include <string>
#include <vector>

namespace pelage::passes {

/// "640 x 640 x 2 RGBA16Float, 4 samples", "64 x 64 x 64 R16Float 3D, 7 levels"; of a buffer, "buffer".
std::string shapeText(const PlanResource& resource);
/// What records it: "list forward", "class Outline", "list shade, class Points", or its shader.
std::string workText(const PlanPass& pass);
/// "6.25 MiB", "64 KiB", "16 B".
std::string byteText(std::uint64_t bytes);
/// "v1"; "v1-v2" of what is changed; "as lent"; "v3 level 2" of one mip level.
std::string versionText(const PlanSlot& slot);
/// "load", "clear" or "-", then "store" or "discard"; empty for a slot that only reads.
std::string loadStoreText(const PlanSlot& slot);

/// A use that cannot begin before an earlier pass is done with the same image or buffer.
struct PlanWait {
    std::uint32_t slot = 0;         // in PlanPass::slots
    std::uint32_t after = ~0U;      // the pass
    SlotUse from = SlotUse::Color;  // how that pass used it; another use is another layout
};
/// By pass. Derived from the plan alone: rhi joins the waits of one pass into one barrier.
std::vector<std::vector<PlanWait>> waitsOf(const Plan& plan);

/// An image that takes over bytes of one that lived before it, as indices into Plan::resources: a wait as well.
struct MemoryTaken {
    std::uint32_t image = ~0U, from = ~0U;
};
/// By pass: of the images that begin there.
std::vector<std::vector<MemoryTaken>> memoryTaken(const Plan& plan);

}  // namespace pelage::passes
