// SPDX-License-Identifier: MIT
// Small valid files made in memory, to be damaged by the tests of the readers.
#pragma once

#include <pelage/hair/load.hpp>

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <span>

namespace pelage::hair::testing {

using Bytes = std::vector<std::byte>;

template <class T>
void append(Bytes& bytes, const T& value) {
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), p, p + sizeof(T));
}
template <class T>
void poke(Bytes& bytes, std::size_t offset, const T& value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// `strands` straight strands of `points` points, 2 cm a segment, hanging from y = 1.
inline Bytes tfxFile(std::uint32_t strands = 4, std::uint32_t points = 5) {
    Bytes b;
    append(b, 4.0F);
    append(b, strands);
    append(b, points);
    append(b, std::uint32_t{160});
    b.resize(160);
    for (std::uint32_t s = 0; s < strands; ++s) {
        for (std::uint32_t i = 0; i < points; ++i) {
            for (const float x : {0.01F * static_cast<float>(s), 1.0F - 0.02F * static_cast<float>(i), 0.0F, 1.0F}) {
                append(b, x);
            }
        }
    }
    return b;
}

inline Strands sampleGroom() {
    Strands g;
    g.first = {0};
    for (std::uint32_t s = 0; s < 5; ++s) {
        for (std::uint32_t i = 0; i < 3 + s; ++i) {
            g.points.push_back({0.01F * static_cast<float>(s), 1.0F - 0.03F * static_cast<float>(i), 0.002F});
            g.widths.push_back(90e-6F - 1e-6F * static_cast<float>(i));
        }
        g.first.push_back(static_cast<std::uint32_t>(g.points.size()));
    }
    g.updateBounds();
    return g;
}

/// A 2 x 2 BMP of 24 bits, the simplest image there is.
inline Bytes bmpFile() {
    Bytes b;
    for (const char c : {'B', 'M'}) append(b, c);
    for (const std::uint32_t x : {70U, 0U, 54U, 40U, 2U, 2U}) append(b, x);
    for (const std::uint16_t x : {std::uint16_t{1}, std::uint16_t{24}}) append(b, x);
    for (const std::uint32_t x : {0U, 16U, 2835U, 2835U, 0U, 0U}) append(b, x);
    for (const int x : {255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 255, 10, 20, 30, 0, 0}) append(b, static_cast<char>(x));
    return b;
}

/// A card of two quads, 10 cm long, hanging along -y, with its document open to changes.
struct GlbFile {
    nlohmann::json json;
    Bytes bin;

    GlbFile() {
        for (int row = 0; row < 3; ++row) {
            for (int side = 0; side < 2; ++side) {
                for (const float x : {0.02F * static_cast<float>(side), -0.05F * static_cast<float>(row), 0.0F}) {
                    append(bin, x);
                }
            }
        }
        for (int row = 0; row < 3; ++row) {
            for (int side = 0; side < 2; ++side) {
                append(bin, static_cast<float>(side));
                append(bin, 0.5F * static_cast<float>(row));
            }
        }
        for (const int i : {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5}) append(bin, static_cast<std::uint16_t>(i));
        const Bytes image = bmpFile();
        bin.insert(bin.end(), image.begin(), image.end());
        json = nlohmann::json::parse(R"({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"bufferView": 3, "mimeType": "image/bmp"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"},
                          {"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 72},
                            {"buffer": 0, "byteOffset": 72, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 120, "byteLength": 24},
                            {"buffer": 0, "byteOffset": 144, "byteLength": 70}],
            "buffers": [{"byteLength": 214}]})");
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    Bytes bytes() const {
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes body = bin;
        body.resize((body.size() + 3) / 4 * 4);
        Bytes out;
        const auto size = static_cast<std::uint32_t>(28 + text.size() + body.size());
        for (const std::uint32_t x : {0x46546C67U, 2U, size, static_cast<std::uint32_t>(text.size()), 0x4E4F534AU}) {
            append(out, x);
        }
        const auto* p = reinterpret_cast<const std::byte*>(text.data());
        out.insert(out.end(), p, p + text.size());
        append(out, static_cast<std::uint32_t>(body.size()));
        append(out, 0x004E4942U);
        out.insert(out.end(), body.begin(), body.end());
        return out;
    }
};

/// Fails unless the outcome is the error `code`, told in one line with a text.
template <class T>
void expectFault(const Result<T>& outcome, const std::string& code) {
    ASSERT_FALSE(outcome.has_value()) << "expected " << code;
    EXPECT_EQ(outcome.error().first().code.text(), code) << outcome.error().first().text;
    EXPECT_EQ(outcome.error().first().severity, Severity::Error);
    EXPECT_FALSE(outcome.error().first().text.empty());
    EXPECT_EQ(outcome.error().items().size(), 1U) << outcome.error().text();
    EXPECT_EQ(toString(outcome.error().first()).find('\n'), std::string::npos);
}

/// Every prefix (or a thousand of them) and `rounds` versions with a few bytes changed.
inline void damage(const Bytes& good, int rounds, const std::function<void(std::span<const std::byte>)>& read) {
    std::minstd_rand random(20240607);
    const std::size_t step = std::max<std::size_t>(1, good.size() / 1000);
    for (std::size_t n = 0; n < good.size(); n += step) {
        const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n));
        read(cut);
    }
    for (int round = 0; round < rounds; ++round) {
        Bytes b = good;
        for (auto flips = 1 + random() % 6; flips > 0; --flips) {
            b[random() % b.size()] = static_cast<std::byte>(random() % 3 == 0 ? 0xFF : random() & 0xFF);
        }
        if (random() % 4 == 0) b.resize(random() % (b.size() + 1));
        read(b);
    }
}

inline void expectSound(const Mesh& g) {
    const auto finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    for (const Vertex& v : g.vertices) {
        ASSERT_TRUE(finite(v.position) && finite(v.normal) && finite(v.tangent));
        ASSERT_NEAR(glm::length(v.normal), 1.0F, 1e-4F);
        ASSERT_NEAR(glm::length(v.tangent), 1.0F, 1e-4F);
        ASSERT_NEAR(glm::dot(v.normal, v.tangent), 0.0F, 1e-3F);
        ASSERT_TRUE(v.strandId >= 0 && v.strandId <= 1 && v.along >= 0 && v.along <= 1);
        ASSERT_TRUE(std::isfinite(v.uv.x) && std::isfinite(v.uv.y));
    }
    for (const std::uint32_t i : g.indices) ASSERT_LT(i, g.vertices.size());
}

inline void expectSound(const Strands& g) {
    ASSERT_EQ(g.first.front(), 0U);
    ASSERT_EQ(g.first.back(), g.points.size());
    ASSERT_TRUE(g.widths.empty() || g.widths.size() == g.points.size());
    ASSERT_TRUE(g.colors.empty() || g.colors.size() == g.points.size());
    ASSERT_TRUE(g.ids.empty() || g.ids.size() == g.strandCount());
    for (std::uint32_t s = 0; s < g.strandCount(); ++s) ASSERT_GE(g.first[s + 1], g.first[s] + 2);
    glm::vec3 low = g.points.front(), high = low;
    for (const glm::vec3& p : g.points) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    ASSERT_EQ(g.boundsMin, low);
    ASSERT_EQ(g.boundsMax, high);
}

}  // namespace pelage::hair::testing
