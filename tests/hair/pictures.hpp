// SPDX-License-Identifier: MIT
// Small scenes and the comparison of pictures for tests that render.
#pragma once

#include <pelage/hair/generate.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>

#include <functional>
#include <string>

namespace pelage::test {

/// The library over the source tree's own data files.
hair::Library& dataLibrary();
hair::Renderer makeRenderer(const std::string& tree = "hair_frame");

/// A preset by name with overrides "group.property" -> text; a bad name or value fails the test.
materials::Material material(const std::string& preset,
                             const std::vector<std::pair<std::string, std::string>>& values = {});

/// Geometry made once per process.
std::shared_ptr<const hair::Strands> strands();  // a wavy groom of 3,000 strands
std::shared_ptr<const hair::Mesh> cards();       // baked from it
std::shared_ptr<const hair::Mesh> head();

/// One card of 2 m in the plane z = 0, normal +z, root at -x; its corners take turns at the tangents.
std::shared_ptr<const hair::Mesh> card(const std::vector<glm::vec3>& tangents = {{1, 0, 0}});

/// Head and hair, portrait lights, studio environment, framed from the front and a little to the side.
hair::Scene portrait(const hair::Geometry& hair, materials::Material hairMaterial);

hair::Picture render(hair::Renderer& renderer, hair::Scene& scene, std::uint32_t size = 192,
                     const std::map<std::string, passes::SettingValue>& settings = {});

/// Mean over covered pixels of the luminance of the linear picture.
double meanLuminance(const hair::Picture& picture);
double coveredFraction(const hair::Picture& picture);

struct Difference {
    double mean = 0;      // of |a - b| over all channels, in 1/255
    double outliers = 0;  // fraction of pixels with a channel that differs by more than 16/255
    double largest = 0;   // in 1/255
};
Difference compare(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

/// Compares the display picture with tests/goldens/NAME.png: mean difference at most 0.5/255 and at most 0.4 % of
/// pixels off by more than 16/255 (another CPU's vector width rounds differently at the edges of strands). On failure
/// the golden, the picture and eight times their difference are written side by side to PELAGE_GOLDEN_FAILURES. With
/// the environment variable PELAGE_UPDATE_GOLDENS set the golden is written instead and the test fails, so that it
/// cannot stay set.
void expectGolden(const hair::Picture& picture, const std::string& name);

}  // namespace pelage::test
