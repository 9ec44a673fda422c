// SPDX-License-Identifier: MIT
// What must hold whatever the picture looks like. Thresholds are stated beside what they bound.
#include "gpu.hpp"
#include "pictures.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

namespace pelage::test {
namespace {

constexpr float radians(float degrees) {
    return degrees * std::numbers::pi_v<float> / 180.0F;
}

const std::vector<std::pair<std::string, std::string>> onlyR = {{"blending.mode", "opaque"},
                                                                {"scattering.enableTT", "false"},
                                                                {"scattering.enableTRT", "false"},
                                                                {"scattering.longitudinalRoughness", "0.05"},
                                                                {"scattering.enableResidual", "false"},
                                                                {"scattering.cuticleTilt", "-8"},
                                                                {"shadowing.mode", "off"},
                                                                {"environment.enable", "false"},
                                                                {"globalScattering.mode", "off"}};

// Radiance of the card in the direction theta_o (towards +x, the tip, when positive), lit from straight above it.
double radianceAt(hair::Renderer& renderer, const std::vector<std::pair<std::string, std::string>>& values,
                  float thetaO) {
    hair::Scene scene;
    scene.objects.push_back({.name = "card", .geometry = card(), .material = material("brown", values)});
    scene.environment = hair::Environment::none();
    scene.lights = {{.direction = {0, 0, -1}, .castsShadow = false}};
    scene.camera = {.eye = glm::vec3(std::sin(thetaO), 0, std::cos(thetaO)) * 40.0F,
                    .target = {0, 0, 0},
                    .verticalFov = 0.01F,  // nearly parallel, and inside the card
                    .nearPlane = 10,
                    .farPlane = 100};
    const hair::Picture picture = render(renderer, scene, 8);
    EXPECT_NEAR(coveredFraction(picture), 1.0, 1e-6);
    return meanLuminance(picture);
}

class Physics : public ::testing::Test {
protected:
    ValidationGuard guard;
    static hair::Renderer& renderer() {
        static hair::Renderer made = makeRenderer();
        return made;
    }
};

// theta_i + theta_o = 2 alpha_R with alpha_R < 0 and u from root to tip (Marschner 2003, table 1): light that falls
// straight on the fibre leaves towards the root.
TEST_F(Physics, HighlightMovesToRoot) {
    float best = 0;
    double most = -1;
    for (float degrees = -40; degrees <= 40; degrees += 2) {
        const double radiance = radianceAt(renderer(), onlyR, radians(degrees));
        if (radiance > most) {
            most = radiance;
            best = degrees;
        }
    }
    EXPECT_LT(best, 0) << "the R lobe leans towards the tip";
    EXPECT_NEAR(best, 2 * -8, 2.01) << "the R lobe is not at twice the tilt";
}

// L_o = S E: twice the light is twice the radiance (16-bit float targets: 2^-11 relative).
TEST_F(Physics, RadianceIsLinearInLight) {
    hair::Scene scene = portrait(cards(), material("brown"));
    scene.environment = hair::Environment::none();
    const double once = meanLuminance(render(renderer(), scene));
    for (hair::Light& light : scene.lights) light.intensity *= 2;
    EXPECT_NEAR(meanLuminance(render(renderer(), scene)) / once, 2.0, 0.01);
}

// Lobes are independent: R, TT, TRT and the residual each alone add up to the four together.
TEST_F(Physics, LobesAddUp) {
    double sum = 0, all = 0;
    for (const char* lobe : {"R", "TT", "TRT", "Residual", "all"}) {
        std::vector<std::pair<std::string, std::string>> values = {{"environment.enable", "false"},
                                                                   {"globalScattering.mode", "off"}};
        if (std::string(lobe) != "all") {
            values.push_back({"scattering.enableR", std::string(lobe) == "R" ? "true" : "false"});
            values.push_back({"scattering.enableTT", std::string(lobe) == "TT" ? "true" : "false"});
            values.push_back({"scattering.enableTRT", std::string(lobe) == "TRT" ? "true" : "false"});
            values.push_back({"scattering.enableResidual", std::string(lobe) == "Residual" ? "true" : "false"});
        }
        hair::Scene scene = portrait(cards(), material("brown", values));
        scene.objects.erase(scene.objects.begin());  // skin would be counted five times
        (std::string(lobe) == "all" ? all : sum) += meanLuminance(render(renderer(), scene));
    }
    EXPECT_NEAR(sum / all, 1.0, 0.005);
}

TEST_F(Physics, WeightZeroIsTheLobeSwitchedOff) {
    hair::Scene off = portrait(cards(), material("brown", {{"scattering.enableTRT", "false"}}));
    hair::Scene zero = portrait(cards(), material("brown", {{"scattering.weightTRT", "0"}}));
    hair::Scene on = portrait(cards(), material("brown"));
    const hair::Picture offPicture = render(renderer(), off), zeroPicture = render(renderer(), zero);
    EXPECT_EQ(offPicture.display, zeroPicture.display);
    // TRT is a few percent of the light, and hair a third of the picture.
    EXPECT_GT(compare(offPicture.display, render(renderer(), on).display).mean, 0.1);
}

// Turning the whole scene, its lights, environment and camera together changes nothing. Shadows are off: the frustum of
// a light has its own up vector, and so samples the shadow map elsewhere.
TEST_F(Physics, RotatingTheSceneChangesNothingButTheCamera) {
    const std::vector<std::pair<std::string, std::string>> values = {{"shadowing.mode", "off"},
                                                                     {"blending.mode", "opaque"}};
    hair::Scene scene = portrait(cards(), material("brown", values));
    scene.objects[0].material = material("skin", {{"shadowing.mode", "off"}});
    const hair::Picture before = render(renderer(), scene);
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0F), 2.1F, glm::normalize(glm::vec3(0.3F, -0.8F, 0.52F)));
    const auto moved = [&](const glm::vec3& p) { return glm::vec3(turn * glm::vec4(p, 1.0F)); };
    for (hair::Object& object : scene.objects) object.transform = turn * object.transform;
    for (hair::Light& light : scene.lights) {
        light.position = moved(light.position);
        light.direction = moved(light.direction);
    }
    scene.environment = scene.environment.rotated(glm::mat3(turn));
    scene.camera.eye = moved(scene.camera.eye);
    scene.camera.target = moved(scene.camera.target);
    scene.camera.up = moved(scene.camera.up);
    const Difference difference = compare(before.display, render(renderer(), scene).display);
    EXPECT_LT(difference.mean, 0.25) << "of 255";
    EXPECT_LT(difference.outliers, 0.004) << "pixels on edges, where rounding decides";
}

// What lies behind the hair as the light sees it is darker, and fades instead of stopping.
TEST_F(Physics, ExponentialShadowLiesBetweenNoneAndHard) {
    const auto luminance = [&](const char* mode) {
        hair::Scene scene =
            portrait(strands(), material("brown", {{"shadowing.mode", mode}, {"environment.enable", "false"}}));
        return meanLuminance(render(renderer(), scene));
    };
    const double off = luminance("off"), exponential = luminance("exponential"), hard = luminance("hard");
    EXPECT_LT(hard, exponential);
    EXPECT_LT(exponential, off);
}

// Cut-out modes agree on how much of the picture is hair, alpha to coverage and hashed alpha within a few percent of
// alpha blending, which is exact where cards do not intersect.
TEST_F(Physics, BlendingModesAgreeOnCoverage) {
    const auto coverage = [&](const char* mode) {
        hair::Scene scene = portrait(cards(), material("brown", {{"blending.mode", mode}}));
        scene.objects.erase(scene.objects.begin());
        return coveredFraction(render(renderer(), scene));
    };
    const double blend = coverage("alphaBlend");
    EXPECT_GT(blend, 0.05);
    EXPECT_NEAR(coverage("hashedAlpha") / blend, 1.0, 0.03);
    EXPECT_NEAR(coverage("alphaToCoverage") / blend, 1.0, 0.15);
    EXPECT_GT(coverage("opaque"), blend);
}

// One sample a pixel and four give the same picture but for the edges.
TEST_F(Physics, MultisamplingKeepsTheMean) {
    hair::Scene scene = portrait(cards(), material("brown", {{"blending.mode", "hashedAlpha"}}));
    const double four = meanLuminance(render(renderer(), scene));
    const double one =
        meanLuminance(render(renderer(), scene, 192, {{"msaa", {passes::SettingValue::Type::Enum, 0, "1"}}}));
    EXPECT_NEAR(one / four, 1.0, 0.03);
}

}  // namespace
}  // namespace pelage::test
