// SPDX-License-Identifier: MIT
#pragma once

#include <pelage/passes/tree.hpp>

namespace pelage::app {

/// A host that lends all that a tree asks for, in the first form that it accepts, and knows its classes, so that it can
/// be compiled without one.
passes::HostDescription generousHost(const passes::PassTree& tree, const rhi::Extent3D& extent);

}  // namespace pelage::app
