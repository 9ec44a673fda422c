// SPDX-License-Identifier: MIT
// Strands to line segments.
#include "loaders_files.hpp"

namespace pelage::hair::testing {
namespace {

TEST(Lines, CurvePassesThroughEveryPoint) {
    const Groom groom = sampleGroom();
    const Geometry lines = toLines(groom, 4, {0, 1, -0.1F});
    expectSound(lines);
    EXPECT_EQ(lines.topology, Topology::Lines);
    EXPECT_EQ(lines.strandCount, groom.strandCount());
    std::size_t vertex = 0;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        const std::uint32_t count = groom.firstPoint[s + 1] - groom.firstPoint[s];
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(lines.vertices[vertex + 4 * i].position, groom.points[groom.firstPoint[s] + i]);
            EXPECT_FLOAT_EQ(lines.vertices[vertex + 4 * i].width, groom.widths[groom.firstPoint[s] + i]);
        }
        vertex += 4 * (count - 1) + 1;
    }
    EXPECT_EQ(vertex, lines.vertices.size());
    EXPECT_EQ(lines.indices.size(), 2 * (lines.vertices.size() - groom.strandCount()));
}

TEST(Lines, TangentsLeadFromRootToTipAndAlongGrows) {
    const Geometry lines = toLines(sampleGroom(), 3, glm::vec3(0));
    for (std::size_t i = 0; i < lines.indices.size(); i += 2) {
        const Vertex &a = lines.vertices[lines.indices[i]], &b = lines.vertices[lines.indices[i + 1]];
        EXPECT_GT(glm::dot(a.tangent, b.position - a.position), 0.0F);
        EXPECT_LT(a.along, b.along);
        EXPECT_EQ(a.strandId, b.strandId);
    }
}

TEST(Lines, StrandsOfTwoPointsAndNoSubdivisionsWork) {
    Groom groom;
    groom.points = {{0, 1, 0}, {0, 0, 0}};
    groom.firstPoint = {0, 2};
    const Geometry lines = toLines(groom, 0, {0, 1, -1});
    ASSERT_EQ(lines.vertices.size(), 2U);
    expectSound(lines);
    EXPECT_FLOAT_EQ(lines.vertices[0].width, 80e-6F);
    EXPECT_NEAR(lines.vertices[0].normal.z, 1.0F, 1e-5F);
}

TEST(Lines, EqualPointsAndEmptyGroomsStayFinite) {
    Groom groom;
    groom.points.assign(4, {1, 2, 3});
    groom.firstPoint = {0, 4};
    expectSound(toLines(groom, 2, {1, 2, 3}));
    EXPECT_TRUE(toLines(Groom{}, 2, glm::vec3(0)).vertices.empty());
}

}  // namespace
}  // namespace pelage::hair::testing
