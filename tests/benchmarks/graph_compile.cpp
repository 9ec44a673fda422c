// SPDX-License-Identifier: MIT
// What compiling a pass tree costs on the CPU: from parsed structs to a plan, for chains of several lengths, for the
// shipped frame, and when nothing has changed. Prints times; asserts none.
#include "random_trees.hpp"

#include <benchmark/benchmark.h>
#include <pelage/passes/graph.hpp>

#include <fstream>
#include <iterator>

namespace pelage::passes {
namespace {

std::shared_ptr<const PassTree> parsed(benchmark::State& state, const std::string& text) {
    const auto tree = PassTree::parse(text, "benchmark.pass.json");
    if (tree) return *tree;
    state.SkipWithError(tree.error().text().c_str());
    return nullptr;
}

void compile(benchmark::State& state, const std::string& text, const HostDescription& host) {
    const auto tree = parsed(state, text);
    for (auto _ : state) {
        if (!tree) break;
        auto plan = tree->compile(host);
        if (!plan) state.SkipWithError(plan.error().text().c_str());
        benchmark::DoNotOptimize(plan);
    }
}

// Each pass reads the results of two others and writes one image.
void compileChain(benchmark::State& state) {
    compile(state, test::chainTree(static_cast<int>(state.range(0))), test::chainTreeHost());
}
BENCHMARK(compileChain)->Arg(6)->Arg(30)->Arg(100)->Arg(200)->Unit(benchmark::kMicrosecond);

HostDescription shippedHost() {
    HostDescription host{.extent = {1920, 1080, 1}};
    host.imports["DisplayConstants"] = {true};
    return host;
}

std::string shippedFrame() {
    std::ifstream in(PELAGE_FRAMES "/hair_frame.pass.json", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void compileShippedFrame(benchmark::State& state) {
    compile(state, shippedFrame(), shippedHost());
}
BENCHMARK(compileShippedFrame)->Unit(benchmark::kMicrosecond);

void parseShippedFrame(benchmark::State& state) {
    const std::string text = shippedFrame();
    for (auto _ : state) {
        auto tree = PassTree::parse(text, "hair_frame.pass.json");
        if (!tree) state.SkipWithError(tree.error().text().c_str());
        benchmark::DoNotOptimize(tree);
    }
}
BENCHMARK(parseShippedFrame)->Unit(benchmark::kMicrosecond);

// The same tree, settings and imports again: what a host pays that calls build() each frame.
void buildUnchanged(benchmark::State& state) {
    const auto instance = rhi::Instance::create();
    const auto adapter = instance ? instance->requestAdapter() : tl::unexpected(instance.error());
    const auto device = adapter ? adapter->requestDevice() : tl::unexpected(adapter.error());
    if (!device) return state.SkipWithError(device.error().text().c_str());
    // Copies between 30 images need no shaders.
    std::string attachments, passes, before = "host.In";
    for (int i = 0; i < 30; ++i) {
        const std::string n = std::to_string(i);
        attachments += (i ? ", \"A" : "\"A") + n + R"(": { "format": "RGBA8Unorm", "size": { "frame": 1 } })";
        passes += std::string(i ? ", " : "") + R"({ "name": "P)" + n +
                  R"(", "kind": "copy", "slots": { "from": { "access": "read", "as": "copy" },
            "to": { "access": "write", "as": "copy" } }, "connect": { "from": ")" +
                  before + R"(", "to": "att.A)" + n + "\" } }";
        before = "P" + n + ".to";
    }
    const auto tree = parsed(state, R"({ "format": "pelage.passtree/1", "name": "Copies",
        "imports": { "In": { "kind": "image", "access": "read" } },
        "settings": { "a": { "type": "uint", "default": 1 }, "b": { "type": "uint", "default": 1 } },
        "attachments": {)" + attachments +
                                        "}, \"passes\": [" + passes + R"(], "exports": { "Out": { "from": ")" + before +
                                        "\" } } }");
    HostDescription host{.extent = {64, 64, 1}};
    host.imports["In"] = {true, rhi::TextureFormat::RGBA8Unorm, {64, 64, 1}, 1};
    host.settings["a"] = host.settings["b"] = {SettingValue::Type::Uint, 2, {}};
    Graph graph({.device = *device});
    if (!tree || !graph.build(*tree, host)) return state.SkipWithError("the graph cannot be built");
    for (auto _ : state) {
        auto built = graph.build(*tree, host);
        benchmark::DoNotOptimize(built);
    }
    if (graph.plansMade() != 1) state.SkipWithError("it was planned again");
}
BENCHMARK(buildUnchanged)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pelage::passes

BENCHMARK_MAIN();
