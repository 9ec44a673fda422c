// SPDX-License-Identifier: MIT
#include "app_files.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace pelage::test {

namespace {

template <class T>
void append(std::string& bytes, const T& value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// A point of strand s, in metres: roots 2 mm apart, hanging down.
void appendPoint(std::string& bytes, std::uint32_t strand, std::uint32_t point, bool notANumber) {
    const float x = 0.002F * static_cast<float>(strand);
    append(bytes, notANumber && point == 1 ? std::numeric_limits<float>::quiet_NaN() : x);
    append(bytes, 1.7F - 0.02F * static_cast<float>(point));
    append(bytes, 0.01F * std::sin(static_cast<float>(point)));
}

void align4(std::string& bytes, char filler) {
    while (bytes.size() % 4 != 0) bytes += filler;
}

}  // namespace

std::string hairFile(std::uint32_t strands, std::uint32_t points, std::uint32_t claimed, bool notANumber) {
    std::string bytes = "HAIR";
    append(bytes, claimed ? claimed : strands);
    append(bytes, strands * points);
    append(bytes, std::uint32_t{2});  // points only
    append(bytes, points == 0 ? 0U : points - 1);
    append(bytes, 80e-6F);
    append(bytes, 0.0F);
    for (int i = 0; i < 3; ++i) append(bytes, 0.3F);
    bytes.resize(128, '\0');
    for (std::uint32_t s = 0; s < strands; ++s) {
        for (std::uint32_t p = 0; p < points; ++p) appendPoint(bytes, s, p, notANumber);
    }
    return bytes;
}

std::string tfxFile(std::uint32_t strands, std::uint32_t points, std::uint32_t claimed, bool notANumber) {
    std::string bytes;
    append(bytes, 4.0F);                         // version
    append(bytes, claimed ? claimed : strands);  // numHairStrands
    append(bytes, points);                       // numVerticesPerStrand
    append(bytes, std::uint32_t{160});           // offsetVertexPosition
    bytes.resize(160, '\0');
    for (std::uint32_t s = 0; s < strands; ++s) {
        for (std::uint32_t p = 0; p < points; ++p) {
            appendPoint(bytes, s, p, notANumber);
            append(bytes, 1.0F);
        }
    }
    return bytes;
}

std::string glbFile(const GlbParts& parts) {
    const std::vector<float> positions{-0.01F, 1.7F, 0, 0.01F, 1.7F, 0, -0.01F, 1.5F, 0, 0.01F, 1.5F, 0};
    const std::vector<float> uvs{0, 0, 1, 0, 0, 1, 1, 1};
    std::string binary;
    for (const float value : positions) {
        append(binary, parts.notANumber ? std::numeric_limits<float>::quiet_NaN() : value);
    }
    for (const float value : uvs) append(binary, value);
    for (const int index : {0, 2, 1, 1, 2, 3}) append(binary, static_cast<std::uint16_t>(index));
    const std::size_t imageAt = binary.size();
    binary += parts.image;

    std::string attributes;
    if (parts.positions) attributes += R"("POSITION":0)";
    if (parts.uvs) attributes += std::string(attributes.empty() ? "" : ",") + R"("TEXCOORD_0":1)";
    std::string views = R"({"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
                        R"({"buffer":0,"byteOffset":80,"byteLength":12})";
    std::string materials;
    if (!parts.image.empty()) {
        views += R"(,{"buffer":0,"byteOffset":)" + std::to_string(imageAt) + R"(,"byteLength":)" +
                 std::to_string(parts.image.size()) + "}";
        materials = R"(,"images":[{"bufferView":3,"mimeType":"image/png"}],"textures":[{"source":0}],)"
                    R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
    }
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
        R"({"attributes":{)" +
        attributes + R"(},"indices":2)" + (parts.image.empty() ? "" : R"(,"material":0)") +
        R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.01,1.5,0],)"
        R"("max":[0.01,1.7,0]},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
        R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)" +
        views + R"(],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]" + materials + "}";
    align4(json, ' ');
    align4(binary, '\0');

    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append(bytes, static_cast<std::uint32_t>(binary.size()));
    bytes += std::string("BIN\0", 4) + binary;
    return bytes;
}

}  // namespace pelage::test
