// SPDX-License-Identifier: MIT
// A plan to look at: one HTML page that needs no network, no script and no other file. Plan::dot() is the same for
// Graphviz. Both can be made of a plan that no device has seen.
#pragma once

#include <pelage/passes/graph.hpp>

#include <string>
#include <utility>
#include <vector>

namespace pelage::passes {

struct PageOptions {
    std::string title = {};                                          // of the page; the tree's name
    std::vector<std::pair<std::string, std::string>> settings = {};  // name and value, shown as they are
    /// What a frame cost, by the names of passes: Graph::reports(). Empty: nothing was measured.
    std::vector<PassReport> measured = {};
    std::uint32_t barriers = 0;  // of that whole frame, as its command buffer counts them
    std::string device = {};     // that it was measured on
};

/// Passes in order, lives and versions of each image over them, the heap as a map of bytes, what each pass waits for,
/// what was culled and why, load and store, and what was measured, times as shares of the frame.
std::string html(const Plan& plan, const PageOptions& options = {});

}  // namespace pelage::passes
