// SPDX-License-Identifier: MIT
// Strands and meshes as data: curves, roots, bounds, policies.
#include "loaders_files.hpp"

#include "geometry/vectors.hpp"

#include <pelage/hair/generate.hpp>

#include <set>

namespace pelage::hair::testing {
namespace {

TEST(Curve, PassesThroughEveryPoint) {
    const Strands strands = sampleGroom();
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const auto points = strands.strand(s);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            EXPECT_EQ(curveAt(points, i, 0), points[i]);
            EXPECT_EQ(curveAt(points, i, 1), points[i + 1]);
        }
    }
}

// Catmull-Rom reproduces parabolas sampled evenly, away from the ends: p(u) = (u, u^2, 0).
TEST(Curve, IsExactForAParabola) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 5; ++i) points.emplace_back(i, i * i, 0);
    for (const float t : {0.1F, 0.5F, 0.8F}) {
        const float u = 1 + t;
        const glm::vec3 p = curveAt(points, 1, t), d = curveDerivative(points, 1, t);
        EXPECT_NEAR(p.x, u, 1e-6F);
        EXPECT_NEAR(p.y, u * u, 1e-6F);
        EXPECT_NEAR(d.x, 1, 1e-6F);
        EXPECT_NEAR(d.y, 2 * u, 1e-5F);
    }
}

// Doubled end points: the tangent at a root is half the way to the next point, at a tip half the way from the last.
TEST(Curve, EndPointsAreDoubled) {
    const std::vector<glm::vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
    EXPECT_EQ(curveDerivative(points, 0, 0), glm::vec3(0.5F, 0, 0));
    EXPECT_EQ(curveDerivative(points, 1, 1), glm::vec3(0, 1, 0));
    EXPECT_EQ(curveDerivative(points, 1, 0), glm::vec3(0.5F, 1, 0));
    const std::vector<glm::vec3> two = {{0, 1, 0}, {0, 0, 0}};
    EXPECT_EQ(curveAt(two, 0, 0.5F), glm::vec3(0, 0.5F, 0));
}

TEST(Curve, EqualPointsStayFinite) {
    const std::vector<glm::vec3> points(4, {1, 2, 3});
    EXPECT_EQ(curveAt(points, 1, 0.3F), points[0]);
    EXPECT_EQ(curveDerivative(points, 1, 0.3F), glm::vec3(0));
}

TEST(Strands, GiveTheirPointsByStrand) {
    Strands strands = {.points = {{0, 0, 0}, {0, 1, 0}, {5, 0, 0}, {5, 1, 0}, {5, 2, 0}}, .first = {0, 2, 5}};
    EXPECT_EQ(strands.strandCount(), 2U);
    EXPECT_EQ(strands.strand(1).size(), 3U);
    EXPECT_EQ(strands.strand(1)[0].x, 5);
    EXPECT_FLOAT_EQ(strands.widthAt(4), 80e-6F);
    strands.widths = {1, 2, 3, 4, 5};
    EXPECT_EQ(strands.widthAt(4), 5);
    strands.first[2] = 6;
    EXPECT_TRUE(strands.strand(1).empty()) << "an offset beyond the points gives nothing to read";
    EXPECT_EQ(Strands{}.strandCount(), 0U);
}

// One stray root in n moves the mean by its share, and would move the middle of a box by half its distance.
TEST(Strands, MiddleOfRootsIsTheirMean) {
    Strands strands;
    strands.first.push_back(0);
    for (const float x : {0.0F, 1.0F, 2.0F, 9.0F}) {
        strands.points.emplace_back(x, 1, 0);
        strands.points.emplace_back(x, -7, 0);
        strands.first.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    EXPECT_EQ(middleOfRoots(strands), glm::vec3(3, 1, 0));
    EXPECT_EQ(middleOfRoots(Strands{}), glm::vec3(0));
}

TEST(Geometry, TellsItsKind) {
    const auto skin = std::make_shared<const Mesh>(makeHead());
    const auto groom = std::make_shared<const Strands>(sampleGroom());
    const Geometry none, head = skin, hair = groom;
    EXPECT_TRUE(isEmpty(none));
    EXPECT_FALSE(isHair(none));
    EXPECT_EQ(meshOf(head), skin.get());
    EXPECT_EQ(strandsOf(head), nullptr);
    EXPECT_FALSE(isHair(head));
    EXPECT_EQ(strandsOf(hair), groom.get());
    EXPECT_TRUE(isHair(hair));
    EXPECT_FALSE(isEmpty(hair));
    glm::vec3 low, high;
    EXPECT_FALSE(boundsOf(none, low, high));
    ASSERT_TRUE(boundsOf(hair, low, high));
    EXPECT_EQ(low, groom->boundsMin);
    EXPECT_EQ(high, groom->boundsMax);
}

TEST(UnitOr, GivesTheFallbackWhereThereIsNoDirection) {
    const glm::vec3 otherwise(0, 1, 0);
    EXPECT_EQ(unitOr(glm::vec3(0), otherwise), otherwise);
    EXPECT_EQ(unitOr(glm::vec3(std::numeric_limits<float>::infinity(), 0, 0), otherwise), otherwise);
    EXPECT_EQ(unitOr(glm::vec3(1e-25F, 0, 0), otherwise), glm::vec3(1, 0, 0));
    EXPECT_EQ(unitOr(glm::vec3(0, 0, -3e30F), otherwise), glm::vec3(0, 0, -1));
}

/// Diameter times length over all segments, m2: what decides how much light passes.
double areaOf(const Strands& strands) {
    double area = 0;
    for (std::uint32_t s = 0; s < strands.strandCount(); ++s) {
        const std::size_t first = strands.first[s];
        const auto points = strands.strand(s);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            area += 0.5 * double(strands.widthAt(first + i) + strands.widthAt(first + i + 1)) *
                    double(glm::length(points[i + 1] - points[i]));
        }
    }
    return area;
}

TEST(Decimated, KeepsTheAreaAndTheStrandsOfSmallerShares) {
    const Strands all = makeGroom({.strands = 2000, .pointsPerStrand = 6});
    const Strands half = decimated(all, 0.5F, 7), tenth = decimated(all, 0.1F, 7);
    EXPECT_EQ(half.strandCount(), 1000U);
    EXPECT_EQ(tenth.strandCount(), 200U);
    expectSound(half);
    EXPECT_NEAR(half.widths[0] / all.widths[0], 2.0F, 1e-5F);
    EXPECT_NEAR(areaOf(half) / areaOf(all), 1.0, 0.02);
    EXPECT_NEAR(areaOf(tenth) / areaOf(all), 1.0, 0.05);
    const std::set<float> ids(half.ids.begin(), half.ids.end());
    for (const float id : tenth.ids) EXPECT_TRUE(ids.count(id));
    EXPECT_EQ(half.center, all.center);
    EXPECT_EQ(decimated(all, 1.0F, 7).points, all.points);
    EXPECT_EQ(decimated(all, 0.0F, 7).strandCount(), 1U) << "something is left to see";
    EXPECT_NE(decimated(all, 0.5F, 8).points, half.points);
}

TEST(FollowStrands, AddCopiesOfEachGuideThatKeepItsAttributes) {
    Strands guides = sampleGroom();
    guides.colors.assign(guides.points.size(), {1, 0.5F, 0});
    const Strands all = withFollowStrands(guides, 3, 1);
    EXPECT_EQ(all.strandCount(), 4 * guides.strandCount());
    expectSound(all);
    EXPECT_EQ(all.colors.size(), all.points.size());
    EXPECT_EQ(all.center, guides.center);
    // Every fourth strand is the guide itself.
    for (std::uint32_t s = 0; s < guides.strandCount(); ++s) {
        const auto guide = guides.strand(s), copy = all.strand(4 * s);
        ASSERT_TRUE(std::equal(guide.begin(), guide.end(), copy.begin(), copy.end()));
        EXPECT_EQ(all.widthAt(all.first[4 * s]), guides.widthAt(guides.first[s]));
    }
}

}  // namespace
}  // namespace pelage::hair::testing
