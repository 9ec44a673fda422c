// SPDX-License-Identifier: MIT
// Properties that hold for every tree: what is exported does not depend on the order among the valid ones, nor on who
// lies where in the heap.
#include "random_trees.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <set>

namespace pelage::passes::test {
namespace {

constexpr int wantedTrees = 300;
constexpr std::uint32_t ordersOfEach = 12;

std::shared_ptr<const PassTree> parsed(const std::string& text) {
    const auto tree = PassTree::parse(text, "random.pass.json");
    EXPECT_TRUE(tree) << tree.error().text() << text;
    return tree ? *tree : nullptr;
}

std::set<std::string> errorsOf(const Diagnostics& diagnostics) {
    std::set<std::string> codes;
    for (const Diagnostic& each : diagnostics.items()) {
        if (each.severity == Severity::Error) codes.insert(std::string(each.code.text()));
    }
    return codes;
}

/// Calls `use(tree, seed)` for each of 300 valid random trees.
template <class Use>
void forEachTree(Use&& use) {
    const HostDescription host = randomHost();
    int valid = 0;
    for (std::uint32_t seed = 0; valid < wantedTrees; ++seed) {
        ASSERT_LT(seed, 4U * wantedTrees) << "too few trees are valid";
        const auto tree = parsed(randomTree(seed));
        ASSERT_TRUE(tree) << "seed " << seed;
        const Linked linked = link(tree->description(), host, {});
        if (!linked.plan) {
            // The only way in which they may fail: an old version read by a pass that needs the new one.
            ASSERT_EQ(errorsOf(linked.plan.error()), std::set<std::string>{"P046"}) << linked.plan.error().text();
            continue;
        }
        ++valid;
        use(*tree, seed);
        if (testing::Test::HasFatalFailure()) return;
    }
}

// What says "after" comes after, though no data says so.
void inOrderOfAfter(const PassTree::Description& tree, const Plan& plan) {
    std::map<std::string, std::size_t> place;
    for (std::size_t i = 0; i < plan.passes.size(); ++i) place[plan.passes[i].name] = i;
    for (const PassDeclaration& pass : tree.passes) {
        for (const OrderedAfter& after : pass.after) {
            if (!place.count(pass.name) || !place.count(after.pass)) continue;
            EXPECT_LT(place[after.pass], place[pass.name]) << pass.name << " after " << after.pass;
        }
    }
}

TEST(RandomTrees, EveryValidOrderGivesTheSameExports) {
    const HostDescription host = randomHost();
    std::size_t passes = 0, different = 0, runs = 0, culled = 0, shared = 0;
    forEachTree([&](const PassTree& tree, std::uint32_t seed) {
        const Linked first = link(tree.description(), host, {});
        const Trace expected = runPlan(*first.plan, 1);
        ASSERT_EQ(expected.fault, "") << "seed " << seed << "\n" << first.plan->dot();
        passes += first.plan->passes.size();
        culled += first.plan->culled.size();
        shared += first.plan->heapBytes < first.plan->naiveBytes ? 1 : 0;
        for (std::uint32_t order = 1; order <= ordersOfEach; ++order) {
            const Linked other = link(tree.description(), host, {.order = order});
            ASSERT_TRUE(other.plan) << other.plan.error().text();
            const Trace made = runPlan(*other.plan, order + 1);
            ASSERT_EQ(made.fault, "") << "seed " << seed << ", order " << order << "\n" << other.plan->dot();
            ASSERT_EQ(made.exports, expected.exports) << "seed " << seed << ", order " << order;
            ASSERT_EQ(made.found, expected.found) << "seed " << seed << ", order " << order;
            ++runs;
            inOrderOfAfter(tree.description(), *other.plan);
            for (std::size_t i = 0; i < other.plan->passes.size(); ++i) {
                if (other.plan->passes[i].name == first.plan->passes[i].name) continue;
                ++different;
                break;
            }
        }
    });
    std::cout << passes << " passes, " << culled << " culled or off, " << different << " of " << runs
              << " orders differ from the default, " << shared << " trees share memory\n";
    // The trees must be such that there is something to see.
    EXPECT_GT(different, runs / 2);
    EXPECT_GT(shared, wantedTrees / 2U);
    EXPECT_GT(culled, wantedTrees / 1U);
}

TEST(RandomTrees, WhoIsAliveAtOnceSharesNoBytes) {
    const HostDescription host = randomHost();
    forEachTree([&](const PassTree& tree, std::uint32_t seed) {
        for (std::uint32_t order = 0; order < 3; ++order) {
            const LinkOptions options{.order = order == 0 ? std::nullopt : std::optional(order)};
            const Linked linked = link(tree.description(), host, options);
            const Plan& plan = *linked.plan;
            std::uint64_t naive = 0;
            for (std::size_t i = 0; i < plan.resources.size(); ++i) {
                const PlanResource& a = plan.resources[i];
                if (a.heapOffset == notPlaced) continue;
                const MemoryNeed need = host.memory(a);
                naive += need.size;
                ASSERT_EQ(a.heapBytes, need.size);
                ASSERT_EQ(a.heapOffset % need.alignment, 0U);
                ASSERT_LE(a.heapOffset + a.heapBytes, plan.heapBytes);
                for (std::size_t j = i + 1; j < plan.resources.size(); ++j) {
                    const PlanResource& b = plan.resources[j];
                    if (b.heapOffset == notPlaced) continue;
                    const bool meet = a.firstPass <= b.lastPass && b.firstPass <= a.lastPass;
                    const bool share =
                        a.heapOffset < b.heapOffset + b.heapBytes && b.heapOffset < a.heapOffset + a.heapBytes;
                    ASSERT_FALSE(meet && share) << a.name << " and " << b.name << ", seed " << seed;
                }
            }
            ASSERT_EQ(plan.naiveBytes, naive);
            ASSERT_GE(plan.heapBytes, plan.peakBytes);
        }
    });
}

TEST(RandomTrees, WhatOutlivesTheFrameLiesAlone) {
    forEachTree([&](const PassTree& tree, std::uint32_t) {
        const Linked linked = link(tree.description(), randomHost(), {});
        const Plan& plan = *linked.plan;
        const auto end = static_cast<std::uint32_t>(plan.passes.size()) - 1;
        for (const auto& [name, index] : plan.exports) ASSERT_EQ(plan.resources[index].lastPass, end) << name;
        for (const PlanResource& image : plan.resources) {
            const bool keeps = image.kind != PlanResource::Kind::Transient || image.partner != none || image.isBuffer;
            ASSERT_EQ(image.heapOffset == notPlaced, keeps) << image.name;
        }
    });
}

TEST(RandomTrees, TwiceThePassesAreTwiceTheWork) {
    const HostDescription host = chainTreeHost();
    const auto visits = [&](int passes) {
        const auto tree = parsed(chainTree(passes));
        const Linked linked = link(tree->description(), host, {});
        EXPECT_TRUE(linked.plan);
        EXPECT_EQ(linked.plan->passes.size(), static_cast<std::size_t>(passes));
        return static_cast<double>(linked.visits);
    };
    const double hundred = visits(100), two = visits(200), four = visits(400);
    std::cout << hundred << ", " << two << " and " << four << " steps for 100, 200 and 400 passes\n";
    EXPECT_LE(two, 2.2 * hundred);
    EXPECT_LE(four, 2.2 * two);
    EXPECT_GE(hundred, 100 * 3) << "each slot is looked at once at least";
}

}  // namespace
}  // namespace pelage::passes::test
