// SPDX-License-Identifier: MIT
// libFuzzer entry point of PassTree: any text gives a tree or lines, any tree a plan or lines. What compiles is drawn
// as a graph, too. hair/data/frames/*.pass.json is a good corpus to start from.
#include <pelage/passes/tree.hpp>

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelage;
    const auto tree = passes::PassTree::parse({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (!tree) {
        if (!tree.error().hasErrors()) std::abort();  // a refusal must say why
        return 0;
    }
    passes::HostDescription host;
    host.extent = {64, 48, 1};
    for (const char* name : {"Scene", "Lights", "DisplayConstants"}) {
        host.imports[name] = {true, rhi::TextureFormat::RGBA16Float, {64, 48, 1}, 1};
    }
    for (const passes::DepthConvention depth :
         {passes::DepthConvention::Reversed, passes::DepthConvention::Conventional}) {
        host.depth = depth;
        const auto plan = (*tree)->compile(host);
        if (plan ? plan->dot().empty() : !plan.error().hasErrors()) std::abort();
    }
    return 0;
}
