#include "common.hpp"
namespace pelage::test { namespace {
using Probe = RhiTest;
TEST_F(Probe, Stats) {
    const auto p = pipeline("full.vert", "buffer.frag");
    const auto values = bufferOf("values", std::vector<float>(16, 0.5F), BufferUsage::Storage);
    const auto g = group(p.bindGroupLayout(0), {{0, BufferBinding{values}}});
    for (int variant = 0; variant < 6; ++variant) {
        const auto set = value(device.createQuerySet({.label = "counts", .type = QueryType::PipelineStatistics, .count = 4}));
        const auto results = buffer("results", 4 * sizeof(PipelineStatistics), BufferUsage::QueryResolve | BufferUsage::CopySrc);
        const auto t = target(64, 64);
        auto encoder = device.createCommandEncoder("statistics");
        for (std::uint32_t i = 0; i < 4; ++i) {
            auto descriptor = clearPass(view(t));
            descriptor.statistics = set; descriptor.statisticsIndex = i;
            auto pass = encoder.beginRenderPass(descriptor);
            pass.setPipeline(p); pass.setBindGroup(0, g);
            if (variant == 0) { pass.setScissorRect(0,0,32,64); pass.draw(3); }
            if (variant == 1) { pass.draw(3); }
            if (variant == 2) { pass.setScissorRect(0,0,32,64); for (unsigned n = 0; n <= i; ++n) pass.draw(3); }
            if (variant == 3) { for (unsigned n = 0; n <= i; ++n) pass.draw(3); }
            if (variant == 4) { pass.setScissorRect(0,0,32, i==0?16:64); pass.draw(3); }
            if (variant == 5) { pass.setScissorRect(0,0,32, i==0?16:64); pass.draw(3); }
            pass.end();
            if (variant == 5) { run(encoder); encoder = device.createCommandEncoder("next"); }
        }
        encoder.resolveQuerySet(set, 0, 4, results, 0);
        run(encoder);
        const auto out = read<PipelineStatistics>(results, 4);
        printf("variant %d:", variant);
        for (auto& o : out) printf(" %lu", (unsigned long)o.fragmentShaderInvocations);
        printf("\n");
    }
}
}}
