// SPDX-License-Identifier: MIT
// Random valid trees, and a machine that runs their plans without a device: an image is the cells it has in the heap,
// what a pass leaves there is a hash of what it found, and whatever a plan says is lost is overwritten.
#pragma once

#include "link.hpp"

#include <random>

namespace pelage::passes::test {

/// Chains, changes in place, readers of old versions, optional slots, alternatives, passes that are off or needed by
/// nobody, exports in the middle, histories. Some wait in a circle; those are not valid, and P046 says so.
std::string randomTree(std::uint32_t seed);
/// A host for it: sizes in the heap are 1..40 cells, at alignments of 1, 2, 4 or 8.
HostDescription randomHost();

/// A chain of `count` fullscreen passes, each of which reads what the one before wrote and what the first one did.
std::string chainTree(int count);
HostDescription chainTreeHost();

struct Trace {
    std::map<std::string, std::uint64_t> exports = {};  // "2 Color": of the third frame
    std::map<std::string, std::uint64_t> found = {};    // "2 Blur": what a pass found in its inputs
    std::string fault = {};  // a pass or the host found something else than what was made for it
};
/// Runs three frames. Memory begins as rubbish that differs from run to run.
Trace runPlan(const Plan& plan, std::uint64_t rubbish);

}  // namespace pelage::passes::test
