// SPDX-License-Identifier: MIT
#include "pictures.hpp"

#include "gpu.hpp"

#include <pelage/hair/load.hpp>

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace pelage::test {

hair::Library& dataLibrary() {
    static hair::Library library(PELAGE_DATA_DIR);
    return library;
}

hair::Renderer makeRenderer(const std::string& tree) {
    auto parsed = dataLibrary().passTree(tree);
    if (!parsed) {
        ADD_FAILURE() << parsed.error().text();
        std::abort();
    }
    auto renderer = hair::Renderer::create({.device = Gpu::get().device, .tree = *parsed});
    if (!renderer) {
        ADD_FAILURE() << renderer.error().text();
        std::abort();
    }
    return *renderer;
}

materials::Material material(const std::string& preset,
                             const std::vector<std::pair<std::string, std::string>>& values) {
    auto parsed = dataLibrary().material(preset);
    if (!parsed) {
        ADD_FAILURE() << parsed.error().text();
        std::abort();
    }
    for (const auto& [id, text] : values) {
        const Diagnostics found = parsed->material.setFromText(id, text);
        EXPECT_TRUE(found.empty()) << found.text();
    }
    return parsed->material;
}

namespace {
const hair::Strands& groom() {
    static const hair::Strands made = hair::makeGroom({.style = hair::Style::Wavy, .strands = 3000, .width = 700e-6F});
    return made;
}
}  // namespace

std::shared_ptr<const hair::Strands> strands() {
    static const auto made = std::make_shared<const hair::Strands>(groom());
    return made;
}
std::shared_ptr<const hair::Mesh> cards() {
    static const auto made =
        std::make_shared<const hair::Mesh>(bakeCards(groom(), {.cards = 120, .textureSize = 512, .segments = 10}));
    return made;
}
std::shared_ptr<const hair::Mesh> head() {
    static const auto made = std::make_shared<const hair::Mesh>(hair::makeHead());
    return made;
}

std::shared_ptr<const hair::Mesh> card(const std::vector<glm::vec3>& tangents) {
    auto made = std::make_shared<hair::Mesh>();
    made->name = "card";
    std::size_t corner = 0;
    for (const float x : {-1.0F, 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            made->vertices.push_back({.position = {x, y, 0},
                                      .normal = {0, 0, 1},
                                      .tangent = tangents[corner++ % tangents.size()],
                                      .uv = {0.5F + 0.5F * y, 0.5F + 0.5F * x},
                                      .along = 0.5F + 0.5F * x});
        }
    }
    made->indices = {0, 1, 2, 2, 1, 3};
    made->islandCount = 1;
    made->updateBounds();
    return made;
}

hair::Scene portrait(const hair::Geometry& hairGeometry, materials::Material hairMaterial) {
    hair::Scene scene;
    scene.objects.push_back({.name = "head", .geometry = head(), .material = material("skin")});
    scene.objects.push_back({.name = "hair", .geometry = hairGeometry, .material = std::move(hairMaterial)});
    glm::vec3 low, high;
    hair::bounds(scene, true, low, high);
    scene.lights = hair::portraitLights(low, high);
    scene.camera = hair::frameBox(low, high, {0.45F, 0.12F, 1.0F}, 1.0F);
    return scene;
}

hair::Picture render(hair::Renderer& renderer, hair::Scene& scene, std::uint32_t size,
                     const std::map<std::string, passes::SettingValue>& settings) {
    auto picture = renderer.render(scene, {.width = size, .height = size, .settings = settings});
    if (!picture) {
        ADD_FAILURE() << picture.error().text();
        hair::Picture empty;
        empty.width = empty.height = size;
        empty.linear.resize(std::size_t{size} * size * 4);
        empty.display.resize(std::size_t{size} * size * 4);
        return empty;
    }
    return std::move(*picture);
}

double meanLuminance(const hair::Picture& picture) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i + 3 < picture.linear.size(); i += 4) {
        sum += 0.2126 * double(picture.linear[i]) + 0.7152 * double(picture.linear[i + 1]) +
               0.0722 * double(picture.linear[i + 2]);
        weight += double(picture.linear[i + 3]);
    }
    return weight > 0 ? sum / weight : 0;
}

double coveredFraction(const hair::Picture& picture) {
    double weight = 0;
    for (std::size_t i = 3; i < picture.linear.size(); i += 4) weight += double(picture.linear[i]);
    return weight / (double(picture.width) * double(picture.height));
}

Difference compare(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    Difference result;
    if (a.size() != b.size() || a.empty()) return {255, 1, 255};
    std::size_t outliers = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int d = std::abs(int(a[i + c]) - int(b[i + c]));
            result.mean += d;
            worst = std::max(worst, d);
        }
        outliers += worst > 16 ? 1 : 0;
        result.largest = std::max(result.largest, double(worst));
    }
    const double pixels = double(a.size() / 4);
    result.mean /= pixels * 3;
    result.outliers = double(outliers) / pixels;
    return result;
}

namespace {

void writePng(const std::string& path, std::uint32_t width, std::uint32_t height,
              const std::vector<std::uint8_t>& rgba) {
    EXPECT_NE(stbi_write_png(path.c_str(), int(width), int(height), 4, rgba.data(), int(width) * 4), 0)
        << "cannot write " << path;
}

std::vector<std::uint8_t> sideBySide(const hair::Picture& picture, const std::vector<std::uint8_t>& golden) {
    const std::size_t row = std::size_t{picture.width} * 4;
    std::vector<std::uint8_t> sheet(row * 3 * picture.height, 255);
    for (std::size_t y = 0; y < picture.height; ++y) {
        for (std::size_t x = 0; x < row; ++x) {
            const std::uint8_t found = picture.display[y * row + x], wanted = golden[y * row + x];
            sheet[y * row * 3 + x] = wanted;
            sheet[y * row * 3 + row + x] = found;
            const int amplified = std::min(8 * std::abs(int(found) - int(wanted)), 255);
            sheet[y * row * 3 + 2 * row + x] = x % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(amplified);
        }
    }
    return sheet;
}

}  // namespace

void expectGolden(const hair::Picture& picture, const std::string& name) {
    const std::string path = std::string(PELAGE_GOLDENS) + "/" + name + ".png";
    if (std::getenv("PELAGE_UPDATE_GOLDENS") != nullptr) {
        std::filesystem::create_directories(PELAGE_GOLDENS);
        writePng(path, picture.width, picture.height, picture.display);
        ADD_FAILURE() << "wrote the golden " << path << "; look at it, then run without PELAGE_UPDATE_GOLDENS";
        return;
    }
    auto bytes = hair::readFile(path);
    ASSERT_TRUE(bytes) << bytes.error().text();
    auto golden = hair::decodeImage(*bytes, path, true);
    ASSERT_TRUE(golden) << golden.error().text();
    ASSERT_EQ(golden->channels, 4U);
    ASSERT_EQ(golden->width, picture.width);
    ASSERT_EQ(golden->height, picture.height);
    const Difference difference = compare(picture.display, golden->texels);
    const bool same = difference.mean <= 0.5 && difference.outliers <= 0.004;
    if (!same) {
        std::filesystem::create_directories(PELAGE_GOLDEN_FAILURES);
        writePng(std::string(PELAGE_GOLDEN_FAILURES) + "/" + name + ".png", picture.width * 3, picture.height,
                 sideBySide(picture, golden->texels));
    }
    EXPECT_TRUE(same) << name << ": mean difference " << difference.mean << "/255 (at most 0.5), "
                      << difference.outliers * 100
                      << " % of pixels off by more than 16/255 (at most 0.4 %); golden, picture and difference x 8 in "
                      << PELAGE_GOLDEN_FAILURES << "/" << name << ".png";
}

}  // namespace pelage::test
