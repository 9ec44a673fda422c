// SPDX-License-Identifier: MIT
// Strands on the device against closed forms: what area they cover, in the picture and in shadow maps, and whose points
// they have when they move.
#include "gpu.hpp"
#include "pictures.hpp"

#include "frame/views.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

namespace pelage::test {
namespace {

constexpr float kHeight = 0.4F;  // m, of the picture at z = 0
constexpr std::uint32_t kSize = 256;
constexpr double kPixel = double(kHeight) / kSize;  // m

/// Looks at the origin along -z so narrowly that it is a parallel projection to a thousandth.
hair::Camera farCamera() {
    const float distance = 40.0F;
    return {.eye = {0, 0, distance},
            .target = {0, 0, 0},
            .verticalFov = 2.0F * std::atan(0.5F * kHeight / distance),
            .nearPlane = 30,
            .farPlane = 50};
}

/// One strand through these points.
hair::Strands strandOf(std::vector<glm::vec3> points, std::vector<float> widths) {
    hair::Strands strands = {.name = "strand", .points = std::move(points), .widths = std::move(widths)};
    strands.first = {0, static_cast<std::uint32_t>(strands.points.size())};
    strands.center = {0, 0, -1};
    strands.updateBounds();
    return strands;
}

/// `count` points on a straight line of `length` m through the origin, at `degrees` from the x axis.
std::vector<glm::vec3> line(float length, float degrees, int count) {
    const float angle = glm::radians(degrees);
    const glm::vec3 direction(std::cos(angle), std::sin(angle), 0);
    std::vector<glm::vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(direction * (length * (float(i) / float(count - 1) - 0.5F)));
    return points;
}

std::vector<float> taper(float from, float to, int count) {
    std::vector<float> widths;
    for (int i = 0; i < count; ++i) widths.push_back(glm::mix(from, to, float(i) / float(count - 1)));
    return widths;
}

class StrandPictures : public ::testing::Test {
protected:
    ValidationGuard guard;
    static hair::Renderer& renderer() {
        static hair::Renderer made = makeRenderer();
        return made;
    }

    /// Blended, so that the alpha of the picture is the coverage itself.
    static hair::Scene sceneOf(hair::Geometry geometry, const glm::mat4& transform = glm::mat4(1.0F)) {
        hair::Scene scene;
        scene.objects.push_back({.name = "hair",
                                 .geometry = std::move(geometry),
                                 .material = material("brown", {{"blending.mode", "alphaBlend"}}),
                                 .transform = transform});
        scene.camera = farCamera();
        scene.lights = {{.direction = {0, 0, -1}, .castsShadow = false}};
        return scene;
    }
    static hair::Picture pictureOf(hair::Geometry geometry, const glm::mat4& transform = glm::mat4(1.0F)) {
        hair::Scene scene = sceneOf(std::move(geometry), transform);
        return render(renderer(), scene, kSize);
    }
    static hair::Geometry shared(hair::Strands strands) {
        return std::make_shared<const hair::Strands>(std::move(strands));
    }
    /// The mean over places within a pixel, so that a line along the raster is not met by all samples or by none.
    static double meanAreaOf(const hair::Geometry& geometry) {
        constexpr int places = 8;
        double sum = 0;
        for (int i = 0; i < places; ++i) {
            const glm::vec2 offset = glm::fract((float(i) + 0.5F) / places * glm::vec2(1, 4)) * float(kPixel);
            sum += areaOf(pictureOf(geometry, glm::translate(glm::mat4(1.0F), glm::vec3(offset, 0))));
        }
        return sum / places;
    }
    /// m2
    static double areaOf(const hair::Picture& picture) {
        double sum = 0;
        for (std::size_t i = 3; i < picture.linear.size(); i += 4) sum += double(picture.linear[i]);
        return sum * kPixel * kPixel;
    }
};

// A straight strand that tapers from w0 to w1 over L covers the trapezoid L (w0 + w1) / 2, whatever its direction.
TEST_F(StrandPictures, WideTaperedStrandCoversItsTrapezoid) {
    const float w0 = 16 * float(kPixel), w1 = 4 * float(kPixel), length = 0.3F;
    for (const float degrees : {0.0F, 17.0F, 45.0F, 90.0F, 118.0F}) {
        for (const int points : {2, 7}) {
            const double area =
                areaOf(pictureOf(shared(strandOf(line(length, degrees, points), taper(w0, w1, points)))));
            EXPECT_NEAR(area / (0.5 * double(length * (w0 + w1))), 1.0, 0.01) << degrees << " degrees, " << points;
        }
    }
}

// Thinner than a pixel it is drawn a pixel wide; the sum of its coverage is still the trapezoid.
TEST_F(StrandPictures, ThinTaperedStrandCoversItsTrapezoid) {
    for (const float degrees : {3.0F, 31.0F, 43.0F, 77.0F}) {
        const float w0 = 0.7F * float(kPixel), w1 = 0.1F * float(kPixel), length = 0.3F;
        const double area = meanAreaOf(shared(strandOf(line(length, degrees, 5), taper(w0, w1, 5))));
        EXPECT_NEAR(area / (0.5 * double(length * (w0 + w1))), 1.0, 0.02) << degrees << " degrees";
    }
}

// From 8 pixels at the root to 2 at the tip, row by row.
TEST_F(StrandPictures, WidthChangesAlongTheStrand) {
    const float w0 = 8 * float(kPixel), w1 = 2 * float(kPixel), length = 0.3F;
    const hair::Picture picture = pictureOf(shared(strandOf(line(length, 90, 4), taper(w0, w1, 4))));
    for (const float along : {0.1F, 0.35F, 0.6F, 0.9F}) {
        // y grows from the root at -L/2 to the tip; rows of the picture come from the top.
        const float y = length * (along - 0.5F);
        const auto middle = static_cast<std::size_t>((0.5F - y / kHeight) * float(kSize));
        double sum = 0;
        for (std::size_t row = middle - 2; row < middle + 3; ++row) {
            for (std::size_t x = 0; x < kSize; ++x) sum += double(picture.linear[(row * kSize + x) * 4 + 3]) / 5;
        }
        EXPECT_NEAR(sum, double(glm::mix(8.0F, 2.0F, along)), 0.2) << "pixels at " << along;
    }
}

// The segments of a bent strand share their corners on the line that halves the angle, so that none is drawn twice or
// not at all: the area is the length times the width.
TEST_F(StrandPictures, BentStrandHasNoGapAndNoOverlap) {
    for (const float bend : {20.0F, 60.0F, 90.0F}) {
        const float half = glm::radians(0.5F * bend), arm = 0.14F, width = 8 * float(kPixel);
        const std::vector<glm::vec3> points = {{-arm * std::cos(half), -arm * std::sin(half), 0},
                                               {0, 0, 0},
                                               {arm * std::cos(half), -arm * std::sin(half), 0}};
        const double area = meanAreaOf(shared(strandOf(points, {width, width, width})));
        EXPECT_NEAR(area / double(2 * arm * width), 1.0, 0.01) << bend << " degrees";
    }
}

TEST_F(StrandPictures, WidthFollowsTheScaleOfTheObject) {
    const float width = 4 * float(kPixel);
    const hair::Geometry strand = shared(strandOf(line(0.15F, 90, 3), taper(width, width, 3)));
    const double once = areaOf(pictureOf(strand));
    EXPECT_NEAR(once / double(0.15F * width), 1.0, 0.02);
    EXPECT_NEAR(areaOf(pictureOf(strand, glm::scale(glm::mat4(1.0F), glm::vec3(2)))) / once, 4.0, 0.08)
        << "twice as long and twice as wide";
    // Across the strand x grows four times and z not at all: the mean is twice.
    EXPECT_NEAR(areaOf(pictureOf(strand, glm::scale(glm::mat4(1.0F), glm::vec3(4, 1, 1)))) / once, 2.0, 0.04);
    EXPECT_NEAR(areaOf(pictureOf(strand, glm::scale(glm::mat4(1.0F), glm::vec3(1, 2, 1)))) / once, 2.0, 0.04)
        << "twice as long and as wide as before";
}

TEST_F(StrandPictures, OneWidthForAllIsThatWidthAtEachPoint) {
    hair::Strands one = strandOf(line(0.3F, 30, 6), {});
    one.width = 5 * float(kPixel);
    hair::Strands each = one;
    each.widths.assign(6, one.width);
    EXPECT_EQ(pictureOf(shared(one)).display, pictureOf(shared(each)).display);
}

// Curves are computed on the device as geometry/curve.cpp says: the curve of few points is the polyline of many.
TEST_F(StrandPictures, SubdividedStrandIsTheCurve) {
    const std::vector<glm::vec3> points = {{-0.15F, -0.1F, 0}, {-0.1F, 0.1F, 0}, {0.08F, 0.08F, 0}, {0.15F, -0.12F, 0}};
    const float width = 3 * float(kPixel);
    hair::Strands curve = strandOf(points, taper(width, width, 4));
    curve.subdivisions = 8;
    std::vector<glm::vec3> fine;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        for (int k = 0; k < 8; ++k) fine.push_back(hair::curveAt(points, i, float(k) / 8));
    }
    fine.push_back(points.back());
    const hair::Picture a = pictureOf(shared(curve));
    const hair::Picture b = pictureOf(shared(strandOf(fine, taper(width, width, int(fine.size())))));
    EXPECT_NEAR(areaOf(a) / areaOf(b), 1.0, 0.002);
    EXPECT_LT(compare(a.display, b.display).outliers, 0.002);
    curve.subdivisions = 1;
    EXPECT_GT(compare(a.display, pictureOf(shared(curve)).display).outliers, 0.01) << "a curve is no polyline";
}

TEST_F(StrandPictures, ColorsFactorTheBaseColorAtEachPoint) {
    const float width = 10 * float(kPixel);
    hair::Strands strands = strandOf(line(0.3F, 0, 4), taper(width, width, 4));
    strands.colors.assign(4, {1, 1, 1});
    const hair::Picture white = pictureOf(shared(strands));
    strands.colors = {{1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
    const hair::Picture tinted = pictureOf(shared(strands));
    strands.colors.clear();
    EXPECT_EQ(pictureOf(shared(strands)).display, white.display);
    const auto at = [&](const hair::Picture& picture, float along) {
        const auto x = static_cast<std::size_t>((0.5F + 0.3F * (along - 0.5F) / kHeight) * float(kSize));
        return picture.linear[(kSize / 2 * kSize + x) * 4];
    };
    EXPECT_NEAR(at(tinted, 0.15F), at(white, 0.15F), 1e-3F * at(white, 0.15F));
    EXPECT_LT(at(tinted, 0.9F), 0.7F * at(white, 0.9F));
}

// A plane under one of two lights: what a strand above it darkens is its own width, in the shadow map of either.
class StrandShadows : public StrandPictures {
protected:
    /// m2 of the plane z = 0 that `strands`, at z = 0.3, keep in the dark of light `which` of two.
    static double shadowOf(hair::Strands strands, std::size_t which) {
        hair::Scene scene;
        scene.camera = farCamera();
        scene.environment = hair::Environment::none();
        // The first light is from far to the side and lights nothing: its view has other pixels.
        scene.lights = {{.direction = {0.2F, 0.9F, -0.3F}}, {.direction = {1, 0, -1}}};
        std::swap(scene.lights[0], scene.lights[1 - which]);
        scene.lights[1 - which].intensity = 0;
        const std::vector<std::pair<std::string, std::string>> values = {
            {"shadowing.mode", "hard"}, {"shadowing.depthBias", "0.02"}, {"blending.mode", "opaque"}};
        scene.objects.push_back({.name = "plane",
                                 .geometry = card(),
                                 .material = material("pbr_brown", values),
                                 .transform = glm::scale(glm::mat4(1.0F), glm::vec3(0.5F))});
        // Outside of the picture; its shadow falls into it.
        scene.objects.push_back({.name = "hair",
                                 .geometry = shared(std::move(strands)),
                                 .material = material("brown", {{"blending.mode", "hashedAlpha"}}),
                                 .transform = glm::translate(glm::mat4(1.0F), glm::vec3(-0.3F, 0, 0.3F))});
        const hair::Picture shadowed = render(renderer(), scene, kSize);
        for (hair::Light& light : scene.lights) light.castsShadow = false;
        const hair::Picture lit = render(renderer(), scene, kSize);
        double sum = 0;
        for (std::size_t i = 0; i < lit.linear.size(); i += 4) {
            if (lit.linear[i] > 0) sum += 1.0 - double(shadowed.linear[i]) / double(lit.linear[i]);
        }
        return sum * kPixel * kPixel;
    }
};

TEST_F(StrandShadows, AreTheTrapezoidInEachMap) {
    const float w0 = 0.04F, w1 = 0.01F, length = 0.3F;
    // Light that falls at 45 degrees across the strand widens its shadow by sqrt(2).
    const double expected = std::numbers::sqrt2 * 0.5 * double(length * (w0 + w1));
    for (const std::size_t which : {0U, 1U})
        EXPECT_NEAR(shadowOf(strandOf(line(length, 90, 5), taper(w0, w1, 5)), which) / expected, 1.0, 0.03) << which;
}

// Strands thinner than a texel shade by their coverage.
TEST_F(StrandShadows, OfThinStrandsHaveTheirAreaOnAverage) {
    hair::Strands strands = {.name = "thin"};
    strands.first.push_back(0);
    constexpr int count = 60;
    const float w0 = 0.5e-3F, w1 = 0.1e-3F, length = 0.3F;  // m; a texel is about 1 mm
    for (int s = 0; s < count; ++s) {
        for (const float t : {0.0F, 0.5F, 1.0F}) {
            strands.points.emplace_back(0.12F * (float(s) / count - 0.5F), length * (t - 0.5F), 0);
            strands.widths.push_back(glm::mix(w0, w1, t));
        }
        strands.first.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    strands.updateBounds();
    const double expected = count * std::numbers::sqrt2 * 0.5 * double(length * (w0 + w1));
    EXPECT_NEAR(shadowOf(strands, 1) / expected, 1.0, 0.06);
}

// Points that move.
class MovingStrands : public StrandPictures {
protected:
    static hair::Strands groom() {
        static const hair::Strands made =
            hair::makeGroom({.style = hair::Style::Wavy, .strands = 300, .pointsPerStrand = 12, .width = 2e-3F});
        return made;
    }
    static std::vector<glm::vec3> moved(float by) {
        std::vector<glm::vec3> points = groom().points;
        for (glm::vec3& p : points) p.x += by * (1.72F - p.y) * (1.72F - p.y);
        return points;
    }
    static hair::Scene scene(hair::Geometry geometry) {
        return portrait(geometry, material("brown", {{"blending.mode", "hashedAlpha"}}));
    }
    static std::vector<std::byte> bytesOf(const rhi::Buffer& buffer) {
        const rhi::Device& device = Gpu::get().device;
        auto copy = device.createBuffer(
            {.label = "copy", .size = buffer.size(), .usage = rhi::BufferUsage::MapRead | rhi::BufferUsage::CopyDst});
        auto encoder = device.createCommandEncoder();
        encoder.copyBufferToBuffer(buffer, 0, *copy, 0, buffer.size());
        auto commands = encoder.finish();
        EXPECT_TRUE(commands);
        auto submission = device.queue().submit(*commands);
        EXPECT_TRUE(submission && device.queue().wait(*submission));
        const auto mapped = copy->mapped();
        return {mapped.begin(), mapped.end()};
    }
    static std::vector<std::byte> bytesOf(const std::vector<glm::vec3>& points) {
        const auto bytes = std::as_bytes(std::span(points));
        return {bytes.begin(), bytes.end()};
    }
};

TEST_F(MovingStrands, EqualAFreshObject) {
    hair::Scene moving = scene(shared(groom()));
    const hair::Picture rest = render(renderer(), moving);
    for (const float by : {0.3F, -0.5F}) {
        const std::vector<glm::vec3> points = moved(by);
        moving.objects[1].moved.points = points;
        hair::Strands fresh = groom();
        fresh.points = points;
        fresh.updateBounds();
        hair::Scene still = moving;
        still.objects[1].moved = {};
        still.objects[1].geometry = shared(fresh);
        const hair::Picture picture = render(renderer(), moving);
        EXPECT_EQ(picture.display, render(renderer(), still).display);
        EXPECT_GT(compare(picture.display, rest.display).mean, 0.3);
    }
    moving.objects[1].moved = {};
    EXPECT_EQ(render(renderer(), moving).display, rest.display) << "what moves no more is at rest again";
}

TEST_F(MovingStrands, KeepThePointsOfTheFrameBefore) {
    hair::Scene moving = scene(shared(groom()));
    hair::Renderer own = makeRenderer();
    EXPECT_EQ(own.strandBuffers(1), nullptr) << "nothing is encoded yet";
    render(own, moving, 64);
    EXPECT_EQ(own.strandBuffers(0), nullptr) << "the head";
    ASSERT_NE(own.strandBuffers(1), nullptr);
    EXPECT_EQ(bytesOf(own.strandBuffers(1)->points), bytesOf(groom().points));
    EXPECT_EQ(own.strandBuffers(1)->previousPoints, own.strandBuffers(1)->points);
    std::vector<glm::vec3> before = groom().points;
    for (const float by : {0.1F, 0.2F, 0.3F}) {
        const std::vector<glm::vec3> points = moved(by);
        moving.objects[1].moved.points = points;
        render(own, moving, 64);
        EXPECT_EQ(bytesOf(own.strandBuffers(1)->points), bytesOf(points));
        EXPECT_EQ(bytesOf(own.strandBuffers(1)->previousPoints), bytesOf(before));
        before = points;
    }
    moving.objects[1].moved = {};
    render(own, moving, 64);
    EXPECT_EQ(bytesOf(own.strandBuffers(1)->points), bytesOf(groom().points));
    EXPECT_EQ(bytesOf(own.strandBuffers(1)->previousPoints), bytesOf(before));
}

/// A buffer as a simulation has it: strands in another order, with unused points between them.
struct Lent {
    std::vector<glm::vec3> points = {};
    std::vector<glm::uvec2> ranges = {};
};
Lent lentOf(const hair::Strands& strands, std::span<const glm::vec3> points) {
    Lent lent;
    lent.ranges.resize(strands.strandCount());
    for (std::uint32_t s = strands.strandCount(); s-- > 0;) {
        lent.points.insert(lent.points.end(), 1 + s % 3, glm::vec3(100));
        const auto at = static_cast<std::uint32_t>(lent.points.size());
        for (std::uint32_t i = strands.first[s]; i < strands.first[s + 1]; ++i) lent.points.push_back(points[i]);
        lent.ranges[s] = {at, static_cast<std::uint32_t>(lent.points.size())};
    }
    return lent;
}

TEST_F(MovingStrands, LentBufferEqualsUploadedPoints) {
    const rhi::Device& device = Gpu::get().device;
    const hair::Strands strands = groom();
    hair::Scene lending = scene(shared(strands)), uploading = lending;
    hair::Renderer own = makeRenderer();
    rhi::Buffer buffer;
    std::vector<std::byte> before;
    for (const float by : {0.3F, -0.2F}) {
        const std::vector<glm::vec3> points = moved(by);
        const Lent lent = lentOf(strands, points);
        const auto bytes = std::as_bytes(std::span(lent.points));
        if (!buffer) {
            buffer = *device.createBuffer(
                {.label = "simulation",
                 .size = bytes.size(),
                 .usage = rhi::BufferUsage::Storage | rhi::BufferUsage::CopySrc | rhi::BufferUsage::CopyDst});
        }
        ASSERT_TRUE(device.queue().writeBuffer(buffer, 0, bytes));
        uploading.objects[1].moved.points = points;
        glm::vec3 low, high;
        ASSERT_TRUE(boundsOf(uploading.objects[1], low, high));
        lending.objects[1].moved = {.buffer = buffer, .ranges = lent.ranges, .boundsMin = low, .boundsMax = high};
        const hair::Picture picture = render(own, lending);
        EXPECT_EQ(picture.display, render(renderer(), uploading).display);
        if (!before.empty()) {
            EXPECT_EQ(bytesOf(own.strandBuffers(1)->previousPoints), before);
        }
        before = {bytes.begin(), bytes.end()};
        before.resize(own.strandBuffers(1)->points.size());
    }
}

TEST_F(MovingStrands, MisfitsAreNamed) {
    hair::Scene moving = scene(shared(groom()));
    const auto codeOf = [&] {
        auto picture = renderer().render(moving, {.width = 32, .height = 32});
        return picture ? std::string() : std::string(picture.error().first().code.text());
    };
    const std::vector<glm::vec3> few(7);
    moving.objects[1].moved.points = few;
    EXPECT_EQ(codeOf(), "N006");
    const rhi::Buffer small =
        *Gpu::get().device.createBuffer({.label = "small", .size = 64, .usage = rhi::BufferUsage::CopySrc});
    moving.objects[1].moved = {.buffer = small};
    EXPECT_EQ(codeOf(), "N006");
    const std::vector<glm::uvec2> ranges(groom().strandCount(), glm::uvec2(0, 5));
    moving.objects[1].moved = {.buffer = small, .ranges = ranges};
    EXPECT_EQ(codeOf(), "N006");
    moving.objects[1].moved = {.buffer = small, .ranges = std::span(ranges).first(3)};
    EXPECT_EQ(codeOf(), "N006");
    moving.objects[1].moved = {};
    EXPECT_EQ(codeOf(), "");
    hair::Strands odd = groom();
    odd.widths.pop_back();
    moving.objects[1].geometry = shared(odd);
    EXPECT_EQ(codeOf(), "N005");
    odd = groom();
    std::swap(odd.first[3], odd.first[4]);
    moving.objects[1].geometry = shared(odd);
    EXPECT_EQ(codeOf(), "N005");
}

// Blended strands are drawn from the farthest segment to the nearest.
TEST_F(MovingStrands, BlendedSegmentsAreSorted) {
    hair::Strands two = {.name = "two"};
    const float width = 30 * float(kPixel);
    // The near strand comes first; drawn in this order the far one would lie on it.
    two.points = {{-0.1F, 0, 0.1F}, {0.1F, 0, 0.1F}, {0, -0.1F, -0.1F}, {0, 0.1F, -0.1F}};
    two.first = {0, 2, 4};
    two.widths.assign(4, width);
    two.colors = {{1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
    two.ids = {0.5F, 0.5F};
    two.updateBounds();
    const auto middle = [](const hair::Picture& picture) {
        return picture.linear[(kSize / 2 * kSize + kSize / 2) * 4];
    };
    const float both = middle(pictureOf(shared(two)));
    hair::Strands swapped = two;
    swapped.points = {two.points[2], two.points[3], two.points[0], two.points[1]};
    swapped.colors = {two.colors[2], two.colors[3], two.colors[0], two.colors[1]};
    EXPECT_EQ(middle(pictureOf(shared(swapped))), both);
    hair::Strands behind = two;
    std::swap(behind.colors[0], behind.colors[2]);
    std::swap(behind.colors[1], behind.colors[3]);
    EXPECT_LT(middle(pictureOf(shared(behind))), 0.9F * both) << "now the dark one is in front";
}

// Strands of very different lengths are cut into pieces; nothing of them is lost.
TEST_F(StrandPictures, LongAndShortStrandsAreDrawnWhole) {
    hair::Strands mixed = {.name = "mixed"};
    mixed.first.push_back(0);
    const float width = 2 * float(kPixel);
    double length = 0;
    for (int s = 0; s < 8; ++s) {
        const int points = s % 2 == 0 ? 2 + s : 150 + 37 * s;
        const float y = 0.04F * (float(s) - 3.5F);
        for (int i = 0; i < points; ++i) {
            mixed.points.emplace_back(0.3F * (float(i) / float(points - 1) - 0.5F), y, 0);
        }
        mixed.first.push_back(static_cast<std::uint32_t>(mixed.points.size()));
        length += 0.3;
    }
    mixed.widths.assign(mixed.points.size(), width);
    mixed.updateBounds();
    EXPECT_NEAR(areaOf(pictureOf(shared(mixed))) / (length * double(width)), 1.0, 0.02);
}

}  // namespace
}  // namespace pelage::test
