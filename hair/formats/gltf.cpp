// SPDX-License-Identifier: MIT
// Cards from glTF: walks the scene, joins all triangle meshes into one geometry, and adds what shading needs.
#include "geometry/islands.hpp"
#include "geometry/vectors.hpp"
#include "gltf_document.hpp"
#include "readers.hpp"
#include "reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <optional>

namespace pelage::hair {
namespace {

using reading::fault;
using reading::remark;
const char* const kExportAgain = "the file is damaged: export it again";

bool isFinite(const glm::dmat4& m) {
    const double* p = glm::value_ptr(m);
    return std::all_of(p, p + 16, [](double x) { return std::isfinite(x) && std::abs(x) < 1e12; });
}

/// The matrix of a node; nullopt where its numbers are too few, too many or not finite.
std::optional<glm::dmat4> localMatrix(const tinygltf::Node& node) {
    glm::dmat4 m(1.0);
    if (!node.matrix.empty()) {
        if (node.matrix.size() != 16) return std::nullopt;
        m = glm::make_mat4(node.matrix.data());
    } else {
        const auto bad = [](const std::vector<double>& v, std::size_t size) { return !v.empty() && v.size() != size; };
        if (bad(node.translation, 3) || bad(node.rotation, 4) || bad(node.scale, 3)) return std::nullopt;
        if (!node.translation.empty()) m = glm::translate(m, glm::make_vec3(node.translation.data()));
        if (!node.rotation.empty()) {
            const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
            if (!(glm::length(q) > 1e-12)) return std::nullopt;
            m *= glm::mat4_cast(glm::normalize(q));
        }
        if (!node.scale.empty()) m = glm::scale(m, glm::make_vec3(node.scale.data()));
    }
    return isFinite(m) ? std::optional(m) : std::nullopt;
}

/// Everything one reading gathers.
class CardReader {
public:
    CardReader(const tinygltf::Model& model, const std::string& name, Diagnostics& notes)
        : model_(model), name_(name), notes_(notes) {
        cards_.name = name;
    }

    Result<Mesh> read() {
        if (auto done = walkScene(); !done) return tl::unexpected(done.error());
        if (cards_.indices.empty()) {
            return reading::fault("G012", name_, "the default scene holds no triangles, expected cards",
                                  "export the meshes together with the scene");
        }
        if (auto read = readTexture(); !read) return tl::unexpected(read.error());
        cards_.updateBounds();
        finish();
        return std::move(cards_);
    }

private:
    Result<void> walkScene() {
        struct Visit {
            int node;
            glm::dmat4 parent;
        };
        std::vector<Visit> pending;
        std::vector<bool> seen(model_.nodes.size(), false);
        for (const int root : roots()) pending.push_back({root, glm::dmat4(1.0)});
        while (!pending.empty()) {
            const Visit visit = pending.back();
            pending.pop_back();
            const std::string self = "node " + std::to_string(visit.node);
            if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= seen.size()) {
                return fault("G015", name_,
                             self + " does not exist; the file has " + std::to_string(seen.size()) + " nodes",
                             kExportAgain);
            }
            const auto index = static_cast<std::size_t>(visit.node);
            if (seen[index]) {
                return fault("G015", name_, self + " is reached twice, expected a tree of nodes", kExportAgain);
            }
            seen[index] = true;
            const tinygltf::Node& node = model_.nodes[index];
            const std::optional<glm::dmat4> local = localMatrix(node);
            const glm::dmat4 world = visit.parent * local.value_or(glm::dmat4(1.0));
            if (!local || !isFinite(world)) {
                return fault("G015", name_, self + " has a transformation that is no finite matrix", kExportAgain);
            }
            if (node.mesh >= 0) {
                if (auto done = addMesh(node.mesh, world); !done) return done;
            }
            for (const int child : node.children) pending.push_back({child, world});
        }
        if (!model_.nodes.empty()) return {};
        for (std::size_t m = 0; m < model_.meshes.size(); ++m) {  // a file without nodes: meshes as they are
            if (auto done = addMesh(static_cast<int>(m), glm::dmat4(1.0)); !done) return done;
        }
        return {};
    }

    /// The default scene's nodes; without scenes, every node that has no parent.
    std::vector<int> roots() const {
        if (!model_.scenes.empty()) {
            const auto scene = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
            return model_.scenes[std::min(scene, model_.scenes.size() - 1)].nodes;
        }
        std::vector<bool> isChild(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) {
                if (child >= 0 && static_cast<std::size_t>(child) < isChild.size()) {
                    isChild[static_cast<std::size_t>(child)] = true;
                }
            }
        }
        std::vector<int> list;
        for (std::size_t i = 0; i < isChild.size(); ++i) {
            if (!isChild[i]) list.push_back(static_cast<int>(i));
        }
        return list;
    }

    Result<void> addMesh(int index, const glm::dmat4& world) {
        if (static_cast<std::size_t>(index) >= model_.meshes.size()) {
            return fault("G015", name_,
                         "mesh " + std::to_string(index) + " does not exist; the file has " +
                             std::to_string(model_.meshes.size()),
                         kExportAgain);
        }
        const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::string place = "mesh " + std::to_string(index) + " primitive " + std::to_string(p);
            if (auto done = addPrimitive(mesh.primitives[p], world, place); !done) return done;
        }
        return {};
    }

    Result<void> addPrimitive(const tinygltf::Primitive& primitive, const glm::dmat4& world, const std::string& place) {
        const int mode = primitive.mode;
        if (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            return fault("G011", name_,
                         place + " has mode " + std::to_string(mode) +
                             " (points or lines), expected triangles, a strip or a fan (4, 5, 6)",
                         "export the cards as triangle meshes; strands belong in .hair or .tfx files");
        }
        for (const char* semantic : {"POSITION", "TEXCOORD_0"}) {
            if (primitive.attributes.contains(semantic)) continue;
            const bool position = semantic[0] == 'P';
            return fault(position ? Code("G006") : Code("G007"), name_, place + " has no " + semantic,
                         position ? "export the mesh again"
                                  : "unwrap the cards: the strand direction is the v axis of their texture");
        }
        const auto first = static_cast<std::uint32_t>(cards_.vertices.size());
        if (auto done = addVertices(primitive, world, place); !done) return done;
        if (auto done = addTriangles(primitive, first, glm::determinant(glm::dmat3(world)) < 0, place); !done)
            return done;
        if (material_ < 0) material_ = primitive.material;
        if (primitive.material >= 0 && primitive.material != material_) otherMaterials_ = true;
        return {};
    }

    Result<void> addVertices(const tinygltf::Primitive& primitive, const glm::dmat4& world, const std::string& place) {
        const auto positions = gltf::elements(model_, primitive.attributes.at("POSITION"), "POSITION", name_);
        if (!positions) return tl::unexpected(positions.error());
        const auto uvs = gltf::elements(model_, primitive.attributes.at("TEXCOORD_0"), "TEXCOORD_0", name_);
        if (!uvs) return tl::unexpected(uvs.error());
        const auto optional = [&](const char* semantic) -> Result<gltf::Elements> {
            const auto found = primitive.attributes.find(semantic);
            if (found == primitive.attributes.end()) return gltf::Elements();
            return gltf::elements(model_, found->second, semantic, name_);
        };
        const auto normals = optional("NORMAL"), tangents = optional("TANGENT");
        if (!normals) return tl::unexpected(normals.error());
        if (!tangents) return tl::unexpected(tangents.error());
        const std::size_t count = positions->count();
        for (const gltf::Elements* other : {&*uvs, &*normals, &*tangents}) {
            if (other->count() == count || (other->count() == 0 && other != &*uvs)) continue;
            return fault("G008", name_,
                         place + " has " + std::to_string(count) + " positions, but another attribute has " +
                             std::to_string(other->count()) + " elements",
                         kExportAgain);
        }
        if (cards_.vertices.size() + count > reading::kMaxVertices) {
            return fault("G013", name_,
                         "the scene has more than the limit of " + std::to_string(reading::kMaxVertices) + " vertices",
                         "export fewer cards");
        }
        if (normals->count() == 0) missingNormals_ = true;
        const glm::dmat3 linear(world);
        // Inverse transpose up to a factor: the cofactor matrix, which also exists where a scale is zero.
        const glm::dmat3 normalMatrix(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                      glm::cross(linear[0], linear[1]));
        const double side = glm::determinant(linear) < 0 ? -1.0 : 1.0;
        const auto vec3At = [](const gltf::Elements& e, std::size_t i) {
            return glm::vec3(e.number(i, 0), e.number(i, 1), e.number(i, 2));
        };
        for (std::size_t i = 0; i < count; ++i) {
            Vertex v;
            v.position = glm::vec3(world * glm::dvec4(vec3At(*positions, i), 1.0));
            v.uv = {uvs->number(i, 0), uvs->number(i, 1)};
            if (!reading::usable(v.position) || !reading::usable(v.uv.x) || !reading::usable(v.uv.y)) {
                return fault("G014", name_,
                             place + " vertex " + std::to_string(i) +
                                 " has a position or texture coordinate that is no finite number below 1e9",
                             "export the mesh again");
            }
            glm::vec3 bitangent(0);
            if (normals->count() != 0) {
                const glm::vec3 n = vec3At(*normals, i);
                v.normal = unitOr(glm::vec3(side * (normalMatrix * glm::dvec3(n))), glm::vec3(0));
                if (tangents->count() != 0) {
                    // glTF's normal maps are y-up, so the bitangent points up the image; the strand runs down it.
                    const glm::vec3 t = vec3At(*tangents, i);
                    const glm::dvec3 down = glm::dvec3(-glm::cross(n, t) * tangents->number(i, 3));
                    bitangent = unitOr(glm::vec3(linear * down), glm::vec3(0));
                }
            }
            cards_.vertices.push_back(v);
            bitangents_.push_back(bitangent);
        }
        return {};
    }

    Result<void> addTriangles(const tinygltf::Primitive& primitive, std::uint32_t first, bool mirrored,
                              const std::string& place) {
        const auto vertices = static_cast<std::uint32_t>(cards_.vertices.size() - first);
        gltf::Elements list;
        if (primitive.indices >= 0) {
            const auto read = gltf::elements(model_, primitive.indices, "indices", name_);
            if (!read) return tl::unexpected(read.error());
            list = *read;
        }
        const bool indexed = primitive.indices >= 0;
        const std::size_t count = indexed ? list.count() : vertices;
        const bool isList = primitive.mode == TINYGLTF_MODE_TRIANGLES;
        const std::size_t triangles = isList ? count / 3 : count < 3 ? 0 : count - 2;
        if (cards_.indices.size() / 3 + triangles > 2 * reading::kMaxVertices) {
            return fault("G013", name_, "the scene has more than 128 Mi triangles", "export fewer cards");
        }
        for (std::size_t i = 0; indexed && i < count; ++i) {
            if (list.index(i) < vertices) continue;
            return fault("G010", name_,
                         place + " index " + std::to_string(i) + " is " + std::to_string(list.index(i)) +
                             ", expected less than its " + std::to_string(vertices) + " vertices",
                         kExportAgain);
        }
        const auto at = [&](std::size_t i) {
            return first + (indexed ? list.index(i) : static_cast<std::uint32_t>(i));
        };
        for (std::size_t t = 0; t < triangles; ++t) {
            std::array<std::uint32_t, 3> corner{};
            if (isList) {
                corner = {at(3 * t), at(3 * t + 1), at(3 * t + 2)};
            } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                corner = {at(0), at(t + 1), at(t + 2)};
            } else {
                corner = {at(t), at(t + 1 + t % 2), at(t + 2 - t % 2)};
            }
            if (mirrored) std::swap(corner[1], corner[2]);
            const bool degenerate = corner[0] == corner[1] || corner[1] == corner[2] || corner[0] == corner[2];
            if (!degenerate) cards_.indices.insert(cards_.indices.end(), corner.begin(), corner.end());
        }
        return {};
    }

    /// The base colour image of the first material; the error names the image that cannot be had.
    Result<void> readTexture() {
        if (material_ < 0) return {};
        const auto missing = [&](const std::string& what) {
            return fault("G016", name_, what + " does not exist, but the cards' material names it", kExportAgain);
        };
        if (static_cast<std::size_t>(material_) >= model_.materials.size()) {
            return missing("material " + std::to_string(material_));
        }
        const tinygltf::Material& material = model_.materials[static_cast<std::size_t>(material_)];
        const int textureIndex = material.pbrMetallicRoughness.baseColorTexture.index;
        if (textureIndex < 0) return {};
        if (static_cast<std::size_t>(textureIndex) >= model_.textures.size()) {
            return missing("texture " + std::to_string(textureIndex));
        }
        const int source = model_.textures[static_cast<std::size_t>(textureIndex)].source;
        if (source < 0 || static_cast<std::size_t>(source) >= model_.images.size()) {
            return missing("image " + std::to_string(source));
        }
        const tinygltf::Image& image = model_.images[static_cast<std::size_t>(source)];
        std::span<const std::byte> encoded = std::as_bytes(std::span(image.image));
        if (image.bufferView >= 0) {
            const auto view = gltf::viewBytes(model_, image.bufferView, name_);
            if (!view) return tl::unexpected(view.error());
            encoded = *view;
        } else if (encoded.empty()) {
            return fault("G005", name_, "the image file \"" + image.uri + "\" that the glTF names cannot be read",
                         "keep the textures beside the .gltf, or export one .glb");
        }
        auto decoded = decodeImage(encoded, name_ + " image " + std::to_string(source), true);
        if (!decoded) return tl::unexpected(decoded.error());
        cards_.colorMap = std::move(*decoded);
        return {};
    }

    void finish() {
        const auto note = [&](Severity severity, Code code, const std::string& text, const char* hint) {
            notes_.add(remark(severity, code, name_, text, hint));
        };
        cards::fillNormals(cards_);
        const std::uint32_t without = cards::fillTangents(cards_, bitangents_);
        cards::fillIslands(cards_);
        if (missingNormals_) {
            note(Severity::Note, "G102", "some meshes have no NORMAL; normals were computed from the triangles", "");
        }
        if (without > 0) {
            note(Severity::Warning, "G103",
                 std::to_string(without) + " of " + std::to_string(cards_.vertices.size()) +
                     " vertices have no texture gradient; their strand direction is a guess",
                 "unwrap the cards so that strands run down the texture");
        }
        if (cards_.colorMap.empty()) {
            note(Severity::Warning, "G104", "the cards have no base colour texture; they are drawn opaque",
                 "give the material a base colour texture with opacity in alpha");
        }
        if (otherMaterials_) {
            note(Severity::Warning, "G105", "the cards use several materials; the first one's texture is used for all",
                 "merge the textures into one atlas");
        }
        if (cards::turnRoundIfUpward(cards_)) {
            note(Severity::Note, "G101",
                 "on most cards v grows upward, so v was taken from tip to root and turned round",
                 "unwrap cards with the root at the top of the image to be sure");
        }
    }

    const tinygltf::Model& model_;
    const std::string& name_;
    Diagnostics& notes_;
    Mesh cards_;
    std::vector<glm::vec3> bitangents_;  // per vertex, +v by the file's TANGENT; zero where it has none
    int material_ = -1;
    bool otherMaterials_ = false, missingNormals_ = false;
};

}  // namespace

Result<Asset> reading::readGltf(Source& source, const std::string& name, Diagnostics& notes) {
    const auto bytes = source.all();
    if (bytes.empty() && source.size() > 0) return cannotRead(name);
    const Result<tinygltf::Model> model = gltf::readDocument(bytes, name, source.folder());
    if (!model) return tl::unexpected(model.error());
    return CardReader(*model, name, notes).read();
}

namespace {

Result<Mesh> meshOnly(reading::Source source, const std::string& name) {
    Diagnostics notes;
    auto asset = reading::readGltf(source, name, notes);
    if (!asset) return tl::unexpected(std::move(asset.error()));
    return std::get<Mesh>(std::move(*asset));
}

}  // namespace

Result<Mesh> parseGltf(std::span<const std::byte> bytes, const std::string& name) {
    return meshOnly(reading::Source(bytes), name);
}

Result<Mesh> loadGltf(const std::string& path) {
    return reading::Source::open(path).and_then(
        [&](reading::Source&& source) { return meshOnly(std::move(source), path); });
}

}  // namespace pelage::hair
