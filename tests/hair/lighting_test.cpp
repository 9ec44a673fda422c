// SPDX-License-Identifier: MIT
// Light and shadow on the device against closed forms. A card of Kajiya-Kay's diffuse part alone is the instrument:
// L = color / pi^2 * E for light that falls straight on the fibre, so radiance tells irradiance.
#include "frame/views.hpp"
#include "gpu.hpp"
#include "pictures.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace pelage::test {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

materials::Material diffuse(Values more = {}) {
    Values values = {
        {"blending.mode", "opaque"},      {"environment.enable", "false"},  {"globalScattering.mode", "off"},
        {"specular.enable", "false"},     {"surface.useStrandId", "false"}, {"surface.useColorMap", "false"},
        {"surface.baseColor", "#ffffff"}, {"diffuse.weight", "1"},          {"shadowing.depthBias", "0"}};
    for (const auto& value : more) {
        std::erase_if(values, [&](const auto& old) { return old.first == value.first; });
        values.push_back(value);
    }
    return material("kajiya_brown", values);
}

// The receiver in the plane z = 0, seen from behind so that what stands before the light hides nothing.
hair::Scene receiver(const materials::Material& material, const std::vector<hair::Light>& lights) {
    hair::Scene scene;
    scene.objects.push_back({.name = "receiver", .geometry = card(), .material = material});
    scene.environment = hair::Environment::none();
    scene.lights = lights;
    scene.camera = {.eye = {0, 0, -4}, .target = {0, 0, 0}, .verticalFov = 0.005F, .nearPlane = 1, .farPlane = 100};
    return scene;
}

void addLayer(hair::Scene& scene, float z, const materials::Material& material) {
    scene.objects.push_back({.name = "layer",
                             .geometry = card(),
                             .material = material,
                             .transform = glm::translate(glm::mat4(1.0F), glm::vec3(0, 0, z))});
}

class Lighting : public ::testing::Test {
protected:
    ValidationGuard guard;
    static hair::Renderer& renderer() {
        static hair::Renderer made = makeRenderer();
        return made;
    }
    double radiance(hair::Scene scene) {
        const hair::Picture picture = render(renderer(), scene, 8);
        EXPECT_NEAR(coveredFraction(picture), 1.0, 1e-6);
        return meanLuminance(picture);
    }
    /// Of the light, behind layers at these heights above the receiver, in m.
    double transmittance(const materials::Material& material, const std::vector<float>& layers,
                         hair::Light light = {.direction = {0, 0, -1}}) {
        light.castsShadow = false;
        const double lit = radiance(receiver(material, {light}));
        light.castsShadow = true;
        hair::Scene scene = receiver(material, {light});
        for (const float z : layers) addLayer(scene, z, material);
        return radiance(scene) / lit;
    }
};

constexpr double pi = std::numbers::pi;

TEST_F(Lighting, DirectionalLightGivesItsIrradiance) {
    for (const float e : {0.5F, 2.0F, 40.0F}) {
        const double l =
            radiance(receiver(diffuse({{"shadowing.mode", "off"}}), {{.direction = {0, 0, -1}, .intensity = e}}));
        EXPECT_NEAR(l * pi * pi / double(e), 1.0, 1e-3) << e << " W/m2";
    }
}

TEST_F(Lighting, PointLightFallsWithTheSquareOfTheDistance) {
    for (const float d : {0.5F, 1.0F, 3.0F, 20.0F}) {
        const double l =
            radiance(receiver(diffuse({{"shadowing.mode", "off"}}),
                              {{.kind = hair::Light::Kind::Point, .position = {0, 0, d}, .intensity = 5.0F}}));
        EXPECT_NEAR(l * pi * pi * double(d) * double(d) / 5.0, 1.0, 1e-3) << d << " m";
    }
}

TEST_F(Lighting, LightsOfAllKindsAddUpToEight) {
    std::vector<hair::Light> lights;
    double e = 0;
    for (std::uint32_t i = 0; i < hair::maxLights; ++i) {
        const float power = 0.25F * static_cast<float>(i + 1);
        const bool isPoint = i % 3 == 1;
        lights.push_back({.kind = isPoint ? hair::Light::Kind::Point : hair::Light::Kind::Directional,
                          .position = {0, 0, 2},
                          .direction = {0, 0, -1},
                          .intensity = power});
        e += double(power) / (isPoint ? 4.0 : 1.0);
        EXPECT_NEAR(radiance(receiver(diffuse({{"shadowing.mode", "hard"}, {"shadowing.depthBias", "0.01"}}), lights)) *
                        pi * pi / e,
                    1.0, 1.5e-3)
            << lights.size() << " lights";
    }
}

// T = exp(-density * d), density = ln 10 / falloff distance, d from the first layer on: 1e-3 of the light.
TEST_F(Lighting, ExponentialShadowIsTheExponentialOfTheDepthBehindTheFirstLayer) {
    for (const double falloff : {0.02, 0.1, 0.5}) {
        const materials::Material material =
            diffuse({{"shadowing.mode", "exponential"}, {"shadowing.falloffDistance", std::to_string(falloff)}});
        for (const float d : {0.004F, 0.02F, 0.1F}) {
            const double wanted = std::exp(-std::numbers::ln10 / falloff * double(d));
            EXPECT_NEAR(transmittance(material, {d}), wanted, 1e-3) << falloff << " m, one layer at " << d;
            EXPECT_NEAR(transmittance(material, {0.5F * d, d}), wanted, 1e-3) << falloff << " m, two layers to " << d;
            const hair::Light point = {.kind = hair::Light::Kind::Point, .position = {0, 0, 6}, .intensity = 36.0F};
            EXPECT_NEAR(transmittance(material, {d}, point), wanted, 1e-3) << falloff << " m, point light, " << d;
        }
    }
}

TEST_F(Lighting, TheBiasMovesTheReceiverTowardTheLight) {
    const materials::Material material = diffuse(
        {{"shadowing.mode", "exponential"}, {"shadowing.falloffDistance", "0.1"}, {"shadowing.depthBias", "0.03"}});
    EXPECT_NEAR(transmittance(material, {0.1F}), std::exp(-std::numbers::ln10 / 0.1 * 0.07), 1e-3);
    EXPECT_NEAR(transmittance(material, {0.02F}), 1.0, 1e-3) << "a layer nearer than the bias";
}

TEST_F(Lighting, HardAndFilteredShadowsAreDarkBehindALayerAndLitBeforeIt) {
    for (const char* mode : {"hard", "pcf"}) {
        const materials::Material material = diffuse({{"shadowing.mode", mode}, {"shadowing.depthBias", "0.002"}});
        EXPECT_EQ(transmittance(material, {0.01F}), 0.0) << mode;
        EXPECT_EQ(transmittance(material, {0.01F, 0.3F}), 0.0) << mode;
        EXPECT_NEAR(transmittance(material, {}), 1.0, 1e-6) << mode << ", no layer";
        EXPECT_NEAR(transmittance(material, {-6.0F}), 1.0, 1e-6) << mode << ", a layer behind (and behind the camera)";
    }
}

// At an edge a window of 2 r + 1 texels sees one column after the other: transmittances are whole multiples of
// 1 / (2 r + 1), each for a texel of the map. Radiance is a 16-bit float: 2^-11 of up to seven.
TEST_F(Lighting, FilteredShadowStepsByColumnsOfItsWindow) {
    for (const int radius : {1, 2, 3}) {
        const materials::Material material = diffuse({{"shadowing.mode", "pcf"},
                                                      {"shadowing.depthBias", "0.01"},
                                                      {"shadowing.pcfRadius", std::to_string(radius)}});
        hair::Scene scene = receiver(material, {{.direction = {0, 0, -1}}});
        addLayer(scene, 0.2F, material);
        // Its edge stands over the middle of the receiver.
        scene.objects.back().transform = glm::translate(scene.objects.back().transform, glm::vec3(1, 0, 0));
        scene.camera.verticalFov = 2.0F * std::atan(0.03F / 4.0F);  // 0.06 m, a map's texel is about 0.003 m
        const std::uint32_t size = 128;
        scene.lights[0].castsShadow = false;
        const double lit = meanLuminance(render(renderer(), scene, 8));
        scene.lights[0].castsShadow = true;
        const hair::Picture picture = render(renderer(), scene, size);
        std::set<int> seen;
        const int steps = 2 * radius + 1;
        for (std::uint32_t x = 0; x < size; ++x) {
            const double t = double(picture.linear[(std::size_t{size} / 2 * size + x) * 4]) / lit * steps;
            EXPECT_NEAR(t, std::round(t), 4e-3) << "pixel " << x << ", radius " << radius;
            seen.insert(static_cast<int>(std::lround(t)));
        }
        EXPECT_EQ(seen.size(), static_cast<std::size_t>(steps) + 1) << "each step, from dark to lit, radius " << radius;
    }
}

// All that is drawn lies inside the view of each light that casts a shadow, wherever the light is.
TEST_F(Lighting, ShadowMapsHoldTheWholeOfTheHair) {
    hair::Scene scene;
    scene.objects.push_back({.name = "hair", .geometry = strands(), .material = diffuse()});
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    // Along its diagonal the box comes nearest to the sphere around it.
    const glm::vec3 diagonal = high - low;
    for (const glm::vec3 d : {diagonal, -diagonal, glm::vec3(1, 1, 1), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),
                              glm::vec3(0.3F, -0.5F, 0.8F), glm::vec3(1, 0, 0)}) {
        const glm::vec3 center = 0.5F * (low + high);
        const auto at = [&](float far) {
            return hair::Light{.kind = hair::Light::Kind::Point,
                               .position = center - far * glm::length(high - low) * glm::normalize(d)};
        };
        scene.lights = {{.direction = d}, at(0.3F), at(0.54F), at(0.7F), at(3.0F), at(100.0F)};
        hair::FrameViews views;
        hair::makeViews(views, scene, {.width = 8, .height = 8}, 1024, 8);
        ASSERT_EQ(views.shadows.size(), scene.lights.size());
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 p = {corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y,
                                     corner & 4 ? low.z : high.z};
                const glm::vec4 clip = views.shadows[i].viewProjection * glm::vec4(p, 1.0F);
                const glm::vec3 ndc = glm::vec3(clip) / clip.w;
                EXPECT_GT(clip.w, 0.0F);
                // Fields of view are at most 2 asin 0.97: a point light just outside sees a little less than the
                // sphere.
                EXPECT_LE(std::max(std::abs(ndc.x), std::abs(ndc.y)), 1.0F) << "light " << i << " corner " << corner;
                EXPECT_GE(ndc.z, 0.0F) << "light " << i << " corner " << corner << " is behind the far plane";
                EXPECT_LE(ndc.z, 1.0F) << "light " << i << " corner " << corner << " is before the near plane";
            }
        }
    }
}

// The same on the device: what is nearest to the light, in the corner of the bounds, casts its shadow.
TEST_F(Lighting, TheFrontOfTheHairCastsItsShadow) {
    const materials::Material material = diffuse({{"shadowing.mode", "hard"}, {"shadowing.depthBias", "0.002"}});
    for (const hair::Light& light : {hair::Light{.direction = {0, 0, -1}},
                                     hair::Light{.kind = hair::Light::Kind::Point, .position = {0, 0, 40}}}) {
        hair::Scene scene = receiver(material, {light});
        // Small beside their distance, so that the first layer nearly touches the sphere around all.
        scene.objects[0].transform = glm::scale(glm::mat4(1.0F), glm::vec3(0.1F));
        addLayer(scene, 4.0F, material);
        scene.objects.back().transform = glm::scale(scene.objects.back().transform, glm::vec3(0.1F));
        EXPECT_EQ(radiance(scene), 0.0);
        scene.lights[0].castsShadow = false;
        EXPECT_GT(radiance(scene), 0.0);
    }
}

}  // namespace
}  // namespace pelage::test
