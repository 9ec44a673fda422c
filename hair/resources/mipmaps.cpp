// SPDX-License-Identifier: MIT
#include "mipmaps.hpp"

#include <pelage/materials/value.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace pelage::hair {
namespace {

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

std::array<float, 256> decodeTable(bool srgb) {
    std::array<float, 256> table = {};
    for (std::size_t i = 0; i < 256; ++i) {
        const float value = static_cast<float>(i) / 255.0F;
        table[i] = srgb ? materials::srgbToLinear(value) : value;
    }
    return table;
}

Image8 withFourChannels(const Image8& image) {
    Image8 result = {image.width, image.height, 4, image.srgb, {}};
    result.texels.reserve(std::size_t{image.width} * image.height * 4);
    for (std::size_t i = 0; i + 1 < image.texels.size(); i += 2) {
        const std::uint8_t grey = image.texels[i], alpha = image.texels[i + 1];
        result.texels.insert(result.texels.end(), {grey, grey, grey, alpha});
    }
    return result;
}

Image8 halved(const Image8& image, const std::array<float, 256>& decode) {
    Image8 result = {std::max(image.width / 2, 1U), std::max(image.height / 2, 1U), image.channels, image.srgb, {}};
    result.texels.resize(std::size_t{result.width} * result.height * result.channels);
    const std::uint32_t channels = image.channels;
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            std::array<float, 4> sum = {}, plain = {};
            float weight = 0;
            for (std::uint32_t tap = 0; tap < 4; ++tap) {
                const std::uint32_t sx = std::min(2 * x + (tap & 1), image.width - 1);
                const std::uint32_t sy = std::min(2 * y + (tap >> 1), image.height - 1);
                const std::uint8_t* texel = &image.texels[(std::size_t{sy} * image.width + sx) * channels];
                const float alpha = channels == 4 ? static_cast<float>(texel[3]) / 255.0F : 1.0F;
                weight += alpha;
                for (std::uint32_t c = 0; c < std::min(channels, 3U); ++c) {
                    sum[c] += alpha * decode[texel[c]];
                    plain[c] += 0.25F * decode[texel[c]];
                }
            }
            std::uint8_t* out = &result.texels[(std::size_t{y} * result.width + x) * channels];
            for (std::uint32_t c = 0; c < std::min(channels, 3U); ++c) {
                const float linear = weight > 0 ? sum[c] / weight : plain[c];
                out[c] = toByte(image.srgb ? materials::linearToSrgb(linear) : linear);
            }
            if (channels == 4) out[3] = toByte(0.25F * weight);
        }
    }
    return result;
}

}  // namespace

std::vector<Image8> mipChain(const Image8& image) {
    std::vector<Image8> levels;
    levels.push_back(image.channels == 2 ? withFourChannels(image) : image);
    const std::array<float, 256> decode = decodeTable(image.srgb);
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back(), decode));
    return levels;
}

}  // namespace pelage::hair
