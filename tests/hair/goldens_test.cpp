// SPDX-License-Identifier: MIT
// Pictures that must not change: every blending mode, each lobe alone, shadows and environment on and off, the
// yardsticks. 192 x 192, on lavapipe.
#include "gpu.hpp"
#include "pictures.hpp"

#include <gtest/gtest.h>

namespace pelage::test {
namespace {

class Goldens : public ::testing::Test {
protected:
    ValidationGuard guard;
    static hair::Renderer& renderer() {
        static hair::Renderer made = makeRenderer();
        return made;
    }
    void check(const hair::Geometry& geometry, const std::string& preset,
               const std::vector<std::pair<std::string, std::string>>& values, const std::string& name) {
        hair::Scene scene = portrait(geometry, material(preset, values));
        expectGolden(render(renderer(), scene), name);
    }
};

TEST_F(Goldens, BlendingOpaque) {
    check(cards(), "brown", {{"blending.mode", "opaque"}}, "blending_opaque");
}
TEST_F(Goldens, BlendingAlphaTest) {
    check(cards(), "brown", {{"blending.mode", "alphaTest"}}, "blending_alpha_test");
}
TEST_F(Goldens, BlendingAlphaToCoverage) {
    check(cards(), "brown", {{"blending.mode", "alphaToCoverage"}}, "blending_alpha_to_coverage");
}
TEST_F(Goldens, BlendingHashedAlpha) {
    check(cards(), "brown", {{"blending.mode", "hashedAlpha"}}, "blending_hashed_alpha");
}
TEST_F(Goldens, BlendingAlphaBlend) {
    check(cards(), "brown", {{"blending.mode", "alphaBlend"}}, "blending_alpha_blend");
}

// Nothing but one lobe: no environment, no ambient term.
std::vector<std::pair<std::string, std::string>> only(const std::string& lobe) {
    return {{"scattering.enableR", lobe == "R" ? "true" : "false"},
            {"scattering.enableTT", lobe == "TT" ? "true" : "false"},
            {"scattering.enableTRT", lobe == "TRT" ? "true" : "false"},
            {"scattering.enableResidual", "false"},
            {"environment.enable", "false"},
            {"globalScattering.mode", "off"}};
}
TEST_F(Goldens, LobeR) {
    check(strands(), "brown", only("R"), "lobe_r");
}
TEST_F(Goldens, LobeTT) {
    check(strands(), "brown", only("TT"), "lobe_tt");
}
TEST_F(Goldens, LobeTRT) {
    check(strands(), "brown", only("TRT"), "lobe_trt");
}

TEST_F(Goldens, ShadowsOn) {
    check(strands(), "brown", {}, "shadows_exponential");
}
TEST_F(Goldens, ShadowsPcf) {
    check(strands(), "brown", {{"shadowing.mode", "pcf"}}, "shadows_pcf");
}
TEST_F(Goldens, ShadowsOff) {
    check(strands(), "brown", {{"shadowing.mode", "off"}}, "shadows_off");
}
TEST_F(Goldens, EnvironmentOff) {
    check(strands(), "brown", {{"environment.enable", "false"}}, "environment_off");
}

TEST_F(Goldens, EnvironmentAlone) {
    hair::Scene scene = portrait(strands(), material("brown"));
    scene.lights.clear();
    expectGolden(render(renderer(), scene), "environment_alone");
}

TEST_F(Goldens, KajiyaKay) {
    check(strands(), "kajiya_brown", {}, "kajiya_kay");
}
TEST_F(Goldens, StandardPbr) {
    check(strands(), "pbr_brown", {}, "standard_pbr");
}

}  // namespace
}  // namespace pelage::test
