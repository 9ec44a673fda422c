// SPDX-License-Identifier: MIT
// What reaches the picture is what the models say, and stays a number whatever the scene does.
#include "gpu.hpp"
#include "pictures.hpp"

#include <pelage/hair/scattering.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelage::test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

class Scattering : public ::testing::Test {
protected:
    ValidationGuard guard;
    static hair::Renderer& renderer() {
        static hair::Renderer made = makeRenderer();
        return made;
    }
};

// A directional light in the direction (theta_i, phi) of the card's frame, the eye at (theta_o, 0).
hair::Scene sceneOf(const materials::Material& material, double thetaI, double phi, double thetaO) {
    hair::Scene scene;
    scene.objects.push_back({.name = "card", .geometry = card(), .material = material});
    scene.environment = hair::Environment::none();
    const glm::dvec3 wi(std::sin(thetaI), std::cos(thetaI) * std::sin(phi), std::cos(thetaI) * std::cos(phi));
    scene.lights = {{.direction = -glm::vec3(wi), .intensity = 1, .castsShadow = false}};
    scene.camera = {.eye = glm::vec3(std::sin(thetaO), 0, std::cos(thetaO)) * 40.0F,
                    .target = {0, 0, 0},
                    .verticalFov = 2e-4F,  // nearly parallel, and inside the card
                    .nearPlane = 10,
                    .farPlane = 100};
    return scene;
}

// L_o = S E_perp, end to end: material file, functors, uniform block, table texture, shader, resolve. Against the C++
// double build of the model; targets hold 11 bits, and the corner pixel is 1e-4 rad off the axis of the camera.
TEST_F(Scattering, RadianceIsWhatTheModelSays) {
    using enum hair::ScatteringModel;
    hair::FiberProperties fiber;
    fiber.eta = 1.5;
    fiber.betaM = 0.3;
    fiber.betaN = 0.25;
    fiber.alpha = -3 * degree;
    fiber.sigmaA = {0.2, 0.4, 0.9};
    hair::MomentTable table(fiber.eta, fiber.betaN);
    for (const hair::ScatteringModel model : {MomentLut, SegmentCdf, Pxr, Karis, Thesis, Gerard, Marschner}) {
        const std::string word(hair::findScatteringModel(model)->id);
        const materials::Material hair = material("brown", {{"blending.mode", "opaque"},
                                                            {"surface.useStrandId", "false"},
                                                            {"shadowing.mode", "off"},
                                                            {"environment.enable", "false"},
                                                            {"globalScattering.mode", "off"},
                                                            {"scattering.model", word},
                                                            {"scattering.ior", "1.5"},
                                                            {"scattering.longitudinalRoughness", "0.3"},
                                                            {"scattering.azimuthalRoughness", "0.25"},
                                                            {"scattering.cuticleTilt", "-3"},
                                                            {"absorption.mode", "sigma"},
                                                            {"absorption.sigma", "0.2,0.4,0.9"}});
        for (const auto& [i, p, o] : {std::array{0.0, 0.0, 0.0},
                                      {20.0, 35.0, -25.0},
                                      {-40.0, 100.0, 30.0},
                                      {10.0, 170.0, -5.0},
                                      {-55.0, 180.0, 60.0}}) {
            const double thetaI = i * degree, phi = p * degree, thetaO = o * degree;
            hair::Scene scene = sceneOf(hair, thetaI, phi, thetaO);
            const hair::Picture picture = render(renderer(), scene, 8);
            const hair::ScatteredLobes s = hair::scatterDouble(
                model, false, fiber, {std::sin(thetaI), std::cos(thetaI), std::sin(thetaO), std::cos(thetaO), phi, {}},
                &table);
            for (std::size_t c = 0; c < 3; ++c) {
                const double expected = s.lobe[0][c] + s.lobe[1][c] + s.lobe[2][c] + s.lobe[3][c];
                EXPECT_NEAR(static_cast<double>(picture.linear[c]), expected, 1.5e-3 * expected + 1e-6)
                    << word << " channel " << c << " at " << i << ", " << p << ", " << o;
            }
        }
    }
}

// The table is made for the index and roughness at hand, and made anew when they move.
TEST_F(Scattering, TheTableFollowsTheMaterial) {
    materials::Material hair = material("brown", {{"blending.mode", "opaque"},
                                                  {"surface.useStrandId", "false"},
                                                  {"shadowing.mode", "off"},
                                                  {"environment.enable", "false"},
                                                  {"globalScattering.mode", "off"}});
    hair::Scene scene = sceneOf(hair, 0, 170 * degree, 0);
    const float before = render(renderer(), scene, 8).linear[0];
    scene.objects[0].material.setFromText("scattering.azimuthalRoughness", "0.7");
    const float after = render(renderer(), scene, 8).linear[0];
    scene.objects[0].material.setFromText("scattering.azimuthalRoughness", "0.3");
    EXPECT_LT(after, 0.8F * before) << "a wider TT lobe is lower at its middle";
    EXPECT_FLOAT_EQ(render(renderer(), scene, 8).linear[0], before);
}

// A light of 10^8 W/sr on the hair itself and beside it, tangents of length 0, 1e-20 and 1e20: every pixel is a number.
TEST_F(Scattering, LightsAndTangentsBeyondReasonGiveNumbers) {
    for (const hair::ModelInfo& info : hair::scatteringModels()) {
        const std::string model(info.id);
        hair::Scene scene =
            sceneOf(material("brown", {{"scattering.model", model}, {"blending.mode", "opaque"}}), 0, 0, 0);
        scene.objects[0].geometry = card({{0, 0, 0}, {1e-20F, 0, 0}, {1e20F, 0, 0}, {1, 0, 0}});
        scene.camera.verticalFov = 0.06F;
        scene.environment = hair::Environment::studio();
        scene.lights = {
            {.kind = hair::Light::Kind::Point, .position = {0, 0, 0}, .intensity = 1e8F, .castsShadow = false},
            {.kind = hair::Light::Kind::Point, .position = {1, 1, 0}, .intensity = 1e8F, .castsShadow = false},
            {.direction = {-1, 0, 0}, .intensity = 1e8F, .castsShadow = false}};
        const hair::Picture picture = render(renderer(), scene, 32);
        EXPECT_GT(coveredFraction(picture), 0.5);
        for (const float value : picture.linear) {
            ASSERT_TRUE(std::isfinite(value)) << model;
            ASSERT_GE(value, 0.0F) << model;
        }
    }
}

}  // namespace
}  // namespace pelage::test
