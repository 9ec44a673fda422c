// SPDX-License-Identifier: MIT
#include "common.hpp"
#include "reflect.hpp"

namespace pelage::test {
namespace {

detail::ReflectedModule reflected(std::string_view name) {
    const auto code = embeddedShader(name);
    return value(detail::reflect({code.begin(), code.end()}, std::string(name)));
}

TEST(Reflection, FindsEveryKindOfBinding) {
    const auto r = reflected("everything.comp").reflection;
    EXPECT_EQ(r.stage, ShaderStage::Compute);
    EXPECT_EQ(r.workgroupSize, (std::array<std::uint32_t, 3>{4, 2, 3}));
    struct Row {
        std::uint32_t group, binding;
        const char* name;
        BindingType type;
        TextureViewDimension dimension;
    };
    const Row rows[] = {{0, 0, "frame", BindingType::UniformBuffer, TextureViewDimension::E2D},
                        {1, 2, "source", BindingType::ReadOnlyStorageBuffer, TextureViewDimension::E2D},
                        {1, 3, "result", BindingType::StorageBuffer, TextureViewDimension::E2D},
                        {2, 0, "image", BindingType::SampledTexture, TextureViewDimension::E2D},
                        {2, 1, "layers", BindingType::SampledTexture, TextureViewDimension::E2DArray},
                        {2, 2, "sky", BindingType::SampledTexture, TextureViewDimension::Cube},
                        {2, 3, "density", BindingType::SampledTexture, TextureViewDimension::E3D},
                        {2, 4, "multi", BindingType::MultisampledTexture, TextureViewDimension::E2D},
                        {2, 5, "filtering", BindingType::Sampler, TextureViewDimension::E2D},
                        {2, 6, "target", BindingType::StorageTexture, TextureViewDimension::E2D},
                        {2, 7, "counters", BindingType::ReadOnlyStorageTexture, TextureViewDimension::E2D}};
    ASSERT_EQ(r.bindings.size(), std::size(rows));
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const auto& b = r.bindings[i];
        EXPECT_EQ(b.group, rows[i].group);
        EXPECT_EQ(b.entry.binding, rows[i].binding);
        EXPECT_EQ(b.entry.name, rows[i].name);
        EXPECT_EQ(b.entry.type, rows[i].type) << rows[i].name;
        EXPECT_EQ(b.entry.viewDimension, rows[i].dimension) << rows[i].name;
    }
}

TEST(Reflection, KnowsBlocksToTheByte) {
    const auto r = reflected("everything.comp").reflection;
    const auto& frame = r.bindings[0];
    EXPECT_EQ(frame.blockSize, 64U + 16 + 2 * 16);
    EXPECT_EQ(frame.entry.minBindingSize, frame.blockSize);
    ASSERT_EQ(frame.members.size(), 4U);
    EXPECT_EQ(frame.members[0].columns, 4U);
    EXPECT_EQ(frame.members[2].name, "time");
    EXPECT_EQ(frame.members[2].offset, 76U);
    EXPECT_EQ(frame.members[2].size, 4U);
    EXPECT_EQ(frame.members[3].arrayLength, 2U);
    EXPECT_EQ(r.bindings[2].blockSize, 4U) << "the run-time array counts for nothing";
    ASSERT_EQ(r.pushConstants.size(), 3U);
    EXPECT_EQ(r.pushConstantsSize, 28U);
    EXPECT_EQ(r.pushConstants[1].scalar, ScalarType::Int);
    EXPECT_EQ(r.pushConstants[1].components, 2U);
}

TEST(Reflection, KnowsConstantsWithTypeAndDefault) {
    const auto r = reflected("everything.comp").reflection;
    ASSERT_EQ(r.specConstants.size(), 4U);
    const auto find = [&](std::string_view name) {
        for (const auto& c : r.specConstants)
            if (c.name == name) return c;
        ADD_FAILURE() << name;
        return SpecConstant{};
    };
    EXPECT_EQ(find("FLAG").type, SpecConstant::Type::Bool);
    EXPECT_EQ(find("FLAG").defaultValue, 1);
    EXPECT_EQ(find("COUNT").type, SpecConstant::Type::Int);
    EXPECT_EQ(find("COUNT").defaultValue, -2);
    EXPECT_EQ(find("SCALE").defaultValue, 1.5);
    EXPECT_EQ(find("SCALE").id, 7U);
    EXPECT_EQ(find("BITS").type, SpecConstant::Type::Uint);
}

TEST(Reflection, KnowsInputsAndOutputs) {
    const auto v = reflected("mesh.vert").reflection;
    ASSERT_EQ(v.inputs.size(), 2U);
    EXPECT_EQ(v.inputs[0].format, VertexFormat::Float32x2);
    EXPECT_EQ(v.inputs[1].name, "color_in");
    const auto f = reflected("two.frag").reflection;
    ASSERT_EQ(f.outputs.size(), 2U);
    EXPECT_EQ(f.outputs[1].format, VertexFormat::Uint32);
    EXPECT_TRUE(reflected("stores.frag").writesStorage);
}

TEST(Reflection, GarbageIsAnErrorAndNeverACrash) {
    const auto code = embeddedShader("everything.comp");
    for (std::size_t n = 0; n < code.size(); n += 7) {  // cut anywhere
        const auto r = detail::reflect({code.begin(), code.begin() + static_cast<std::ptrdiff_t>(n)}, "cut");
        EXPECT_TRUE(r || r.error().code == ErrorCode::ShaderInvalid);
    }
    EXPECT_EQ(detail::reflect({1, 2, 3, 4, 5, 6}, "noise").error().code, ErrorCode::ShaderInvalid);
    const auto combined = embeddedShader("combined.frag");
    const auto r = detail::reflect({combined.begin(), combined.end()}, "[ShaderModule \"old\"]");
    ASSERT_FALSE(r);
    EXPECT_NE(r.error().first().text.find("combined sampler \"image\""), std::string::npos) << r.error().first().text;
}

}  // namespace
}  // namespace pelage::test
