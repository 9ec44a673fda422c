// SPDX-License-Identifier: MIT
// A host of pelage::rhi and pelage::passes that knows nothing of hair: compiles a frame of its own into a plan, opens a
// device and has it read a shader that is none.
#include <pelage/passes/tree.hpp>
#include <pelage/rhi/rhi.hpp>

#include <cstdio>
#include <string>

using namespace pelage;

namespace {

constexpr const char* frame = R"({
  "format": "pelage.passtree/1", "name": "Consumer",
  "attachments": { "Picture": { "format": "RGBA8Unorm", "size": { "frame": 1 } } },
  "passes": [ { "name": "Fill", "kind": "fullscreen", "shader": "fill.frag",
                "slots": { "color": { "access": "write", "as": "color" } }, "connect": { "color": "att.Picture" } } ],
  "exports": { "Picture": { "from": "Fill.color" } }
})";

int failed(const std::string& why) {
    std::fprintf(stderr, "consumer: %s\n", why.c_str());
    return 1;
}

}  // namespace

int main() {
    const auto tree = passes::PassTree::parse(frame, "consumer.pass.json");
    if (!tree) return failed(tree.error().text());
    passes::HostDescription host{.extent = {320, 200, 1}};
    const auto plan = (*tree)->compile(host);
    if (!plan) return failed(plan.error().text());
    for (const passes::PlanPass& pass : plan->passes) std::printf("%s\n", pass.name.c_str());
    if (plan->passes.empty()) return failed("the frame has no passes");

    const auto instance = rhi::Instance::create({.label = "consumer"});
    if (!instance) return failed(instance.error().text());
    const auto adapter = instance->requestAdapter();
    if (!adapter) return failed(adapter.error().text());
    const auto device = adapter->requestDevice();
    if (!device) return failed(device.error().text());
    const auto shader = device->createShaderModule({.label = "no shader", .code = {1, 2, 3}});
    if (shader) return failed("three numbers were taken for a shader");
    std::printf("%s\n", shader.error().text().c_str());
    return 0;
}
