// SPDX-License-Identifier: MIT
// The head, grooms and cards that Pelage makes itself.
#include "loaders_files.hpp"

#include "generate/head.hpp"

#include <pelage/hair/generate.hpp>

#include <cstdlib>

namespace pelage::hair::testing {
namespace {

template <class T>
std::uint64_t hashOf(const std::vector<T>& values) {
    std::uint64_t hash = 14695981039346656037ULL;
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) hash = (hash ^ bytes[i]) * 1099511628211ULL;
    return hash;
}

GroomDescriptor smallGroom(Style style, std::uint32_t seed = 1) {
    GroomDescriptor d;
    d.style = style;
    d.strands = 1500;
    d.seed = seed;
    return d;
}

TEST(Head, IsAClosedMannequinOfTheStatedSize) {
    const Mesh head = makeHead();
    expectSound(head);
    EXPECT_FALSE(head.isHair);
    EXPECT_NEAR(head.boundsMax.y, 1.72F, 0.003F);
    EXPECT_LT(head.boundsMin.y, 1.26F);
    EXPECT_GT(head.indices.size() / 3, 5000U);
    EXPECT_LT(head.indices.size() / 3, 25000U);
    // Closed: every directed edge has its opposite exactly once.
    std::vector<std::uint64_t> edges, opposite;
    for (std::size_t i = 0; i < head.indices.size(); ++i) {
        const std::uint64_t a = head.indices[i], b = head.indices[i % 3 == 2 ? i - 2 : i + 1];
        edges.push_back(a << 32 | b);
        opposite.push_back(b << 32 | a);
    }
    std::sort(edges.begin(), edges.end());
    std::sort(opposite.begin(), opposite.end());
    EXPECT_EQ(edges, opposite);
    // Normals agree with the winding, and the nose is in front.
    std::size_t agree = 0;
    float noseY = 0, noseZ = -1;
    for (std::size_t i = 0; i < head.indices.size(); i += 3) {
        const auto& v = head.vertices;
        const glm::vec3 a = v[head.indices[i]].position;
        const glm::vec3 n = glm::cross(v[head.indices[i + 1]].position - a, v[head.indices[i + 2]].position - a);
        agree += glm::dot(n, v[head.indices[i]].normal) >= 0;
        if (a.z > noseZ) noseZ = a.z, noseY = a.y;
    }
    EXPECT_GT(agree, head.indices.size() / 3 * 99 / 100);
    EXPECT_NEAR(noseY, 1.555F, 0.02F);
}

class Grooms : public ::testing::TestWithParam<Style> {};

TEST_P(Grooms, SameSeedSameBytesOtherSeedOtherHair) {
    const Strands a = makeGroom(smallGroom(GetParam())), b = makeGroom(smallGroom(GetParam()));
    EXPECT_EQ(hashOf(a.points), hashOf(b.points));
    EXPECT_EQ(hashOf(a.widths), hashOf(b.widths));
    EXPECT_NE(hashOf(a.points), hashOf(makeGroom(smallGroom(GetParam(), 2)).points));
}

TEST_P(Grooms, StrandsStayOutsideTheHeadAndStartOnTheScalp) {
    for (const float length : {0.08F, 0.26F, 0.45F}) {
        GroomDescriptor d = smallGroom(GetParam());
        d.length = length;
        const Strands groom = makeGroom(d);
        ASSERT_EQ(groom.strandCount(), d.strands);
        expectSound(groom);
        for (const glm::vec3& p : groom.points) ASSERT_GT(headDistance(p), -0.001F);
        for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
            ASSERT_NEAR(headDistance(groom.points[groom.first[s]]), 0.0F, 0.0005F);
            ASSERT_TRUE(isScalp(groom.points[groom.first[s]]));
        }
    }
}

TEST_P(Grooms, LengthsLieAroundTheMean) {
    const GroomDescriptor d = smallGroom(GetParam());
    const Strands groom = makeGroom(d);
    double sum = 0;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        float length = 0;
        for (std::uint32_t i = groom.first[s] + 1; i < groom.first[s + 1]; ++i) {
            length += glm::length(groom.points[i] - groom.points[i - 1]);
        }
        // A ponytail's strands also have their way to the tie, at most 25 cm.
        const float way = GetParam() == Style::Ponytail ? 0.25F : 0.0F;
        ASSERT_GT(length, 0.4F * d.length);
        ASSERT_LT(length, 1.6F * d.length + way);
        sum += static_cast<double>(length);
    }
    const double mean = sum / groom.strandCount();
    EXPECT_GT(mean, 0.8 * static_cast<double>(d.length));
    EXPECT_LT(mean, 1.6 * static_cast<double>(d.length));
}

TEST_P(Grooms, ExactlyThePointsAskedFor) {
    for (const std::uint32_t points : {0U, 2U, 3U, 64U}) {
        GroomDescriptor d = smallGroom(GetParam());
        d.strands = 50;
        d.pointsPerStrand = points;
        const Strands groom = makeGroom(d);
        EXPECT_EQ(groom.points.size(), std::size_t{50} * std::max(points, 2U));
        expectSound(groom);
    }
    GroomDescriptor none;
    none.strands = 0;
    EXPECT_EQ(makeGroom(none).strandCount(), 0U);
}

TEST_P(Grooms, HairHangs) {
    const Strands groom = makeGroom(smallGroom(GetParam()));
    double drop = 0;
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
        drop += static_cast<double>(groom.points[groom.first[s]].y - groom.points[groom.first[s + 1] - 1].y);
    }
    EXPECT_GT(drop / groom.strandCount(), 0.08);
}

/// Cells of a grid (2.5 mm, seen from the front or the side) that something covers.
class Silhouette {
public:
    explicit Silhouette(bool side) : side_(side) {}
    void mark(const glm::vec3& p) {
        const auto column = static_cast<std::ptrdiff_t>(((side_ ? p.z : p.x) + 0.5F) / kCell);
        const auto row = static_cast<std::ptrdiff_t>((p.y - 1.0F) / kCell);
        if (column >= 0 && column < kSide && row >= 0 && row < kSide) {
            cells_[static_cast<std::size_t>(row * kSide + column)] = true;
        }
    }
    double area() const { return static_cast<double>(std::count(cells_.begin(), cells_.end(), true)); }

private:
    static constexpr float kCell = 0.0025F;
    static constexpr std::ptrdiff_t kSide = 400;
    bool side_;
    std::vector<bool> cells_ = std::vector<bool>(kSide * kSide, false);
};

TEST_P(Grooms, CardsCoverAboutWhatStrandsCover) {
    GroomDescriptor d = smallGroom(GetParam());
    d.strands = 12000;
    const Strands groom = makeGroom(d);
    const Mesh cards = bakeCards(groom, {});
    expectSound(cards);
    for (const bool side : {false, true}) {
        Silhouette strands(side), strips(side);
        for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
            const auto points = groom.strand(s);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                for (const float t : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) strands.mark(curveAt(points, i, t));
            }
        }
        for (std::size_t t = 0; t < cards.indices.size(); t += 3) {
            const Vertex &a = cards.vertices[cards.indices[t]], &b = cards.vertices[cards.indices[t + 1]],
                         &c = cards.vertices[cards.indices[t + 2]];
            constexpr int kSteps = 24;
            for (int i = 0; i <= kSteps; ++i) {
                for (int j = 0; i + j <= kSteps; ++j) {
                    const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps, w = 1 - u - v;
                    const glm::vec2 uv = w * a.uv + u * b.uv + v * c.uv;
                    const auto x = static_cast<std::size_t>(uv.x * static_cast<float>(cards.colorMap.width));
                    const auto y = static_cast<std::size_t>(uv.y * static_cast<float>(cards.colorMap.height));
                    if (cards.colorMap.texels[4 * (y * cards.colorMap.width + x) + 3] < 128) continue;
                    strips.mark(w * a.position + u * b.position + v * c.position);
                }
            }
        }
        const double ratio = strips.area() / strands.area();
        RecordProperty(side ? "side" : "front", std::to_string(ratio));
        EXPECT_GT(ratio, 0.72);
        EXPECT_LT(ratio, 1.2);
    }
}

TEST_P(Grooms, CardsLeadFromRootToTipAndFaceOutward) {
    const Mesh cards = bakeCards(makeGroom(smallGroom(GetParam())), {});
    std::size_t outward = 0, onHead = 0;
    for (const Vertex& v : cards.vertices) {
        if (v.position.z < -0.115F) continue;  // the tail of a ponytail also has a side towards the head
        outward += glm::dot(v.normal, v.position - headCenter()) > 0;
        ++onHead;
    }
    EXPECT_GT(outward, onHead * 9 / 10);
    // Rows of 4 vertices follow each other down a card.
    std::size_t agree = 0, all = 0;
    for (std::size_t i = 0; i + 4 < cards.vertices.size(); ++i) {
        const Vertex &a = cards.vertices[i], &b = cards.vertices[i + 4];
        if (a.strandId != b.strandId) continue;
        EXPECT_LT(a.along, b.along);
        EXPECT_LT(a.uv.y, b.uv.y);
        agree += glm::dot(a.tangent, b.position - a.position) > 0;
        ++all;
    }
    EXPECT_GT(agree, all * 97 / 100);
}

std::string styleName(const ::testing::TestParamInfo<Style>& style) {
    switch (style.param) {
        case Style::Straight:
            return "Straight";
        case Style::Wavy:
            return "Wavy";
        case Style::Curly:
            return "Curly";
        default:
            return "Ponytail";
    }
}

INSTANTIATE_TEST_SUITE_P(All, Grooms, ::testing::Values(Style::Straight, Style::Wavy, Style::Curly, Style::Ponytail),
                         styleName);

TEST(Cards, CellsDoNotTouchAndIdsAreEverywhere) {
    const Mesh cards = bakeCards(makeGroom(smallGroom(Style::Straight)), {});
    EXPECT_EQ(cards.colorMap.width, 1024U);
    EXPECT_EQ(cards.strandIdMap.channels, 1U);
    const std::size_t empty = static_cast<std::size_t>(
        std::count(cards.strandIdMap.texels.begin(), cards.strandIdMap.texels.end(), std::uint8_t{0}));
    EXPECT_LT(empty, cards.strandIdMap.texels.size() / 20);
    for (const Vertex& v : cards.vertices) {
        ASSERT_TRUE(v.uv.x > 0 && v.uv.x < 1 && v.uv.y > 0 && v.uv.y < 1);
    }
}

TEST(Cards, OddRequestsAreServed) {
    EXPECT_TRUE(bakeCards(Strands{}, {}).vertices.empty());
    const Strands groom = makeGroom(smallGroom(Style::Wavy));
    expectSound(bakeCards(groom, {.cards = 1, .textureSize = 1, .segments = 0, .seed = 3}));
    expectSound(bakeCards(groom, {.cards = 5000, .textureSize = 300, .segments = 3, .seed = 3}));
    expectSound(bakeCards(sampleGroom(), {}));
    Strands point;  // strands without length do not come from the readers, but may come from a host
    point.points.assign(4, {1, 1, 1});
    point.first = {0, 2, 4};
    expectSound(bakeCards(point, {}));
    EXPECT_TRUE(bakeCards(groom, {.cards = 0}).vertices.empty());
}

TEST(Cards, RealGroomBakes) {
    const char* folder = std::getenv("PELAGE_ASSETS");
    if (folder == nullptr) GTEST_SKIP() << "PELAGE_ASSETS does not name the folder of real assets";
    const auto groom = loadTfx(std::string(folder) + "/strands/ratboy/Ratboy_mohawk.tfx");
    ASSERT_TRUE(groom);
    expectSound(bakeCards(*groom, {}));
}

}  // namespace
}  // namespace pelage::hair::testing
