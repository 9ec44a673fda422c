// SPDX-License-Identifier: MIT
// Environments as spherical harmonics. Basis and cosine-lobe factors: Ramamoorthi and Hanrahan, "An Efficient
// Representation for Irradiance Environment Maps", SIGGRAPH 2001.
#include <pelage/hair/scene.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage::hair {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Real spherical harmonics of bands 0..2 with +Y up: the polar axis of the basis is y.
std::array<float, 9> basis(const glm::vec3& d) {
    return {0.282095F,
            0.488603F * d.z,
            0.488603F * d.y,
            0.488603F * d.x,
            1.092548F * d.x * d.z,
            1.092548F * d.z * d.y,
            0.315392F * (3.0F * d.y * d.y - 1.0F),
            1.092548F * d.x * d.y,
            0.546274F * (d.x * d.x - d.z * d.z)};
}

// Convolution with the clamped cosine: pi, 2 pi / 3, pi / 4 by band.
constexpr std::array<float, 9> cosineLobe = {pi,     2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4,
                                             pi / 4, pi / 4,     pi / 4,     pi / 4};

// Integrates `radiance` over the sphere on a grid of equal steps in theta and phi.
template <class Function>
std::array<glm::vec3, 9> project(std::uint32_t rows, std::uint32_t columns, const Function& radiance) {
    std::array<glm::vec3, 9> coefficients = {};
    for (std::uint32_t row = 0; row < rows; ++row) {
        const float theta = pi * (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
        const float weight = std::sin(theta) * (pi / static_cast<float>(rows)) * (2 * pi / static_cast<float>(columns));
        for (std::uint32_t column = 0; column < columns; ++column) {
            const float phi = 2 * pi * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
            const glm::vec3 d = {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
            const std::array<float, 9> y = basis(d);
            const glm::vec3 value = radiance(row, column, d) * weight;
            for (std::size_t i = 0; i < 9; ++i) coefficients[i] += value * y[i];
        }
    }
    return coefficients;
}

}  // namespace

Environment Environment::studio() {
    Environment result;
    result.radiance = project(64, 128, [](std::uint32_t, std::uint32_t, const glm::vec3& d) {
        const glm::vec3 floor = {0.10F, 0.09F, 0.08F}, dome = {0.42F, 0.46F, 0.52F};
        glm::vec3 value = glm::mix(floor, dome, glm::smoothstep(-0.4F, 0.9F, d.y));
        const auto box = [&](const glm::vec3& towards, float sharpness, const glm::vec3& color) {
            value += color * std::exp(sharpness * (glm::dot(d, glm::normalize(towards)) - 1.0F));
        };
        box({0.8F, 0.7F, 0.7F}, 12.0F, {1.5F, 1.35F, 1.15F});
        box({-0.9F, 0.4F, 0.1F}, 9.0F, {0.45F, 0.55F, 0.7F});
        return value;
    });
    return result;
}

Environment Environment::uniform(const glm::vec3& radiance) {
    Environment result;
    result.radiance[0] = radiance * (std::sqrt(4.0F * pi));
    return result;
}

Environment Environment::fromEquirect(std::uint32_t width, std::uint32_t height, std::span<const float> rgb) {
    Environment result;
    if (width == 0 || height == 0 || rgb.size() < std::size_t{width} * height * 3) return none();
    result.radiance = project(height, width, [&](std::uint32_t row, std::uint32_t column, const glm::vec3&) {
        const std::size_t at = (std::size_t{row} * width + column) * 3;
        const auto finite = [](float value) { return std::isfinite(value) ? std::max(value, 0.0F) : 0.0F; };
        return glm::vec3(finite(rgb[at]), finite(rgb[at + 1]), finite(rgb[at + 2]));
    });
    return result;
}

glm::vec3 Environment::irradiance(const glm::vec3& normal) const {
    const std::array<float, 9> y = basis(normal);
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < 9; ++i) sum += radiance[i] * (cosineLobe[i] * y[i]);
    return glm::max(sum * intensity, glm::vec3(0.0F));
}

glm::vec3 Environment::meanRadiance() const {
    return glm::max(radiance[0] * (0.282095F * intensity), glm::vec3(0.0F));
}

Environment Environment::rotated(const glm::mat3& rotation) const {
    // Nine directions determine nine coefficients; projecting the turned function on a grid is simpler and as exact.
    Environment result;
    result.intensity = intensity;
    const glm::mat3 inverse = glm::transpose(rotation);
    result.radiance = project(96, 192, [&](std::uint32_t, std::uint32_t, const glm::vec3& d) {
        const std::array<float, 9> y = basis(inverse * d);
        glm::vec3 sum(0.0F);
        for (std::size_t i = 0; i < 9; ++i) sum += radiance[i] * y[i];
        return sum;
    });
    return result;
}

}  // namespace pelage::hair
