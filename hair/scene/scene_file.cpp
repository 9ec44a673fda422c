// SPDX-License-Identifier: MIT
// A scene file is checked against its schema first, so what follows reads values whose kinds are known and only has to
// judge what a schema cannot say: names that must exist, directions that must not be zero.
#include <pelage/base/json.hpp>
#include <pelage/hair/scene_file.hpp>
#include <pelage/hair/settings.hpp>

#include "scene_parts.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

namespace pelage::hair {

namespace fs = std::filesystem;

namespace {

float toFloat(const json::Value& value) {
    return static_cast<float>(value.number);
}
std::uint32_t toUint(const json::Value& value) {
    return static_cast<std::uint32_t>(value.number);
}

glm::vec3 toVector(const json::Value& value) {
    return {toFloat(value.elements[0]), toFloat(value.elements[1]), toFloat(value.elements[2])};
}

float numberOr(const json::Value& object, std::string_view key, float otherwise) {
    const json::Value* value = object.find(key);
    return value ? toFloat(*value) : otherwise;
}

std::uint32_t uintOr(const json::Value& object, std::string_view key, std::uint32_t otherwise) {
    const json::Value* value = object.find(key);
    return value ? toUint(*value) : otherwise;
}

std::string wordOr(const json::Value& object, std::string_view key, std::string otherwise) {
    const json::Value* value = object.find(key);
    return value ? value->string : std::move(otherwise);
}

glm::vec3 vectorOr(const json::Value& object, std::string_view key, const glm::vec3& otherwise) {
    const json::Value* value = object.find(key);
    return value ? toVector(*value) : otherwise;
}

/// A value as a person would type it for Material::setFromText; nothing for arrays of other things than numbers.
std::optional<std::string> asText(const json::Value& value) {
    switch (value.kind) {
        case json::Kind::Bool:
            return value.boolean ? "true" : "false";
        case json::Kind::String:
            return value.string;
        case json::Kind::Number: {
            char digits[40] = {};
            const auto end = std::to_chars(digits, digits + sizeof digits, value.number).ptr;
            return std::string(digits, end);
        }
        case json::Kind::Array: {
            std::string text;
            for (const json::Value& element : value.elements) {
                if (!element.isNumber()) return std::nullopt;
                text += (text.empty() ? "" : ",") + *asText(element);
            }
            return text;
        }
        case json::Kind::Null:
        case json::Kind::Object:
            break;
    }
    return std::nullopt;
}

/// Text that is equal for values written alike.
std::string keyOf(const json::Value& value) {
    if (!value.isObject()) return asText(value).value_or("");
    std::string key;
    for (const json::Member& member : value.members) key += member.key + "=" + keyOf(member.value) + ";";
    return key;
}

class SceneReader {
public:
    SceneReader(const json::Document& document, Library& library) : document_(document), library_(library) {
        directory_ = fs::path(document.file).parent_path();
    }

    Result<SceneFile> read() {
        const json::Value& root = document_.root;
        result_.passTree = pathOrName(wordOr(root, "passTree", result_.passTree));
        for (const json::Value& object : root.find("objects")->elements) readObject(object);
        if (const json::Value* lights = root.find("lights")) {
            for (const json::Value& light : lights->elements) readLight(light);
        } else {
            glm::vec3 low, high;
            bounds(result_.scene, true, low, high);
            result_.scene.lights = portraitLights(low, high);
        }
        if (const json::Value* environment = root.find("environment")) readEnvironment(*environment);
        if (const json::Value* frame = root.find("frame")) readFrame(*frame);
        readCamera(root.find("camera"));
        result_.scene.background = vectorOr(root, "background", result_.scene.background);
        result_.scene.exposure = numberOr(root, "exposure", result_.scene.exposure);
        if (faults_.hasErrors()) {
            faults_.sortByPlace();
            return tl::unexpected(std::move(faults_));
        }
        return std::move(result_);
    }

private:
    void fault(Code code, const json::Place& place, std::string text, std::string hint) {
        faults_.add({.code = code,
                     .file = document_.file,
                     .line = place.line,
                     .column = place.column,
                     .text = std::move(text),
                     .hint = std::move(hint)});
    }

    /// A fault found elsewhere that names no place of its own gets the place in this file that led to it.
    Diagnostic placed(Diagnostic diagnostic, const json::Place& place) const {
        if (diagnostic.file.empty()) {
            diagnostic.file = document_.file;
            diagnostic.line = place.line;
            diagnostic.column = place.column;
        }
        return diagnostic;
    }
    void adopt(const Diagnostics& found, const json::Place& place) {
        for (const Diagnostic& diagnostic : found.items()) faults_.add(placed(diagnostic, place));
    }

    std::string relative(const std::string& path) const {
        return fs::path(path).is_absolute() ? path : (directory_ / path).lexically_normal().string();
    }
    /// Names of shipped things stay as they are; what looks like a path is relative to this file.
    std::string pathOrName(const std::string& text) const {
        return text.find('/') != std::string::npos || text.ends_with(".json") ? relative(text) : text;
    }

    parts::GenerateRequest request(const json::Value& value) const {
        parts::GenerateRequest wanted;
        const std::string kind = wordOr(value, "kind", "groom");
        wanted.source = kind == "head"    ? parts::Source::Head
                        : kind == "cards" ? parts::Source::Cards
                                          : parts::Source::Groom;
        const std::string style = wordOr(value, "style", "wavy");
        GroomDescriptor& groom = wanted.groom;
        groom.style = style == "straight"   ? Style::Straight
                      : style == "curly"    ? Style::Curly
                      : style == "ponytail" ? Style::Ponytail
                                            : Style::Wavy;
        groom.strands = uintOr(value, "strands", groom.strands);
        groom.pointsPerStrand = uintOr(value, "pointsPerStrand", groom.pointsPerStrand);
        groom.length = numberOr(value, "length", groom.length);
        groom.width = numberOr(value, "width", groom.width);
        groom.seed = uintOr(value, "seed", groom.seed);
        wanted.cards.cards = uintOr(value, "cards", wanted.cards.cards);
        wanted.cards.textureSize = uintOr(value, "textureSize", wanted.cards.textureSize);
        wanted.cards.segments = uintOr(value, "segments", wanted.cards.segments);
        wanted.cards.seed = groom.seed;
        return wanted;
    }

    std::optional<Geometry> geometryOf(const json::Value& object) {
        const json::Value* asset = object.find("asset");
        const json::Value* generate = object.find("generate");
        if ((asset == nullptr) == (generate == nullptr)) {
            fault(
                "S001", object.place,
                "the object \"" + wordOr(object, "name", "") + "\" has " +
                    (asset ? "both \"asset\" and \"generate\"" : "neither \"asset\" nor \"generate\"") +
                    ", expected exactly one",
                asset ? "remove one of them" : "add \"asset\": \"file.glb\" or \"generate\": { \"kind\": \"groom\" }");
            return std::nullopt;
        }
        const std::uint32_t subdivisions = uintOr(object, "subdivisions", 1);
        // Objects with the same source share one geometry, and so one upload.
        const std::string key = std::to_string(subdivisions) + keyOf(asset ? *asset : *generate);
        if (const auto known = geometries_.find(key); known != geometries_.end()) return known->second;
        if (generate) return geometries_[key] = parts::generate(request(*generate), subdivisions);
        auto loaded = parts::loadGeometry(relative(asset->string), subdivisions, result_.notes);
        if (!loaded) {
            adopt(loaded.error(), asset->place);
            return std::nullopt;
        }
        return geometries_[key] = *loaded;
    }

    void readObject(const json::Value& value) {
        const auto geometry = geometryOf(value);
        if (!geometry) return;
        const json::Value* name = value.find("material");
        auto parsed = library_.material(name ? pathOrName(name->string) : parts::defaultMaterial(*geometry));
        if (!parsed) return adopt(parsed.error(), name ? name->place : value.place);
        result_.notes.append(parsed->warnings);
        Object object{
            .name = value.find("name")->string, .geometry = *geometry, .material = std::move(parsed->material)};
        if (const json::Value* set = value.find("set")) readOverrides(*set, object.material);
        if (const json::Value* transform = value.find("transform")) object.transform = transformOf(*transform);
        result_.scene.objects.push_back(std::move(object));
    }

    void readOverrides(const json::Value& set, materials::Material& material) {
        for (const json::Member& member : set.members) {
            for (Diagnostic each : material.set(member.key, member.value).items()) {
                const bool isError = each.severity == Severity::Error;
                (isError ? faults_ : result_.notes).add(placed(std::move(each), member.value.place));
            }
        }
    }

    glm::mat4 transformOf(const json::Value& value) {
        glm::mat4 matrix = glm::translate(glm::mat4(1.0F), vectorOr(value, "translate", glm::vec3(0)));
        if (const json::Value* rotate = value.find("rotate")) {
            if (const auto axis = direction(*rotate, "axis")) {
                matrix = glm::rotate(matrix, glm::radians(numberOr(*rotate, "angle_deg", 0)), *axis);
            }
        }
        return glm::scale(matrix, glm::vec3(numberOr(value, "scale", 1.0F)));
    }

    std::optional<glm::vec3> direction(const json::Value& object, std::string_view key) {
        const json::Value* value = object.find(key);
        if (!value) return std::nullopt;
        const glm::vec3 vector = toVector(*value);
        if (glm::length(vector) > 1e-12F) return glm::normalize(vector);
        fault("S003", value->place, "\"" + std::string(key) + "\" is the zero vector, expected a direction",
              "give it a length");
        return std::nullopt;
    }

    void unknownLight(const json::Value& kind) {
        std::vector<std::string> words;
        std::string list;
        for (const LightKindInfo& info : lightKinds()) {
            words.emplace_back(info.word);
            list += (list.empty() ? "" : ", ") + words.back();
        }
        const std::string_view near = nearestName(kind.string, words);
        fault("S008", kind.place, "there is no kind of light \"" + kind.string + "\", expected one of " + list,
              near.empty() ? "choose one of them" : "did you mean \"" + std::string(near) + "\"?");
    }

    void readLight(const json::Value& value) {
        Light light;
        const std::string& word = value.find("kind")->string;
        const auto kinds = lightKinds();
        const auto info = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.word == word; });
        if (info == kinds.end()) return unknownLight(*value.find("kind"));
        light.kind = info->kind;
        for (const auto& [member, wanted] :
             {std::pair{"position", info->hasPosition}, std::pair{"direction", info->hasDirection}}) {
            const json::Member* found = value.member(member);
            if (wanted && !found)
                fault("S004", value.place, "a " + word + " light lacks \"" + member + "\"",
                      std::string("add \"") + member + "\": [x, y, z]");
            if (!wanted && found)
                fault("S005", found->place, "a " + word + " light has no \"" + member + "\"",
                      "remove it, or change \"kind\"");
        }
        light.position = vectorOr(value, "position", light.position);
        light.direction = direction(value, "direction").value_or(light.direction);
        light.color = vectorOr(value, "color", light.color);
        light.intensity = numberOr(value, "intensity", light.intensity);
        if (const json::Value* shadow = value.find("castsShadow")) light.castsShadow = shadow->boolean;
        result_.scene.lights.push_back(light);
    }

    void readEnvironment(const json::Value& value) {
        const std::string kind = wordOr(value, "kind", "studio");
        Environment environment = kind == "none" ? Environment::none() : Environment::studio();
        if (kind == "uniform") environment = Environment::uniform(vectorOr(value, "radiance", glm::vec3(1)));
        if (kind != "none") environment.intensity = numberOr(value, "intensity", 1.0F);
        if (const float turn = numberOr(value, "turn_deg", 0); turn != 0) {
            environment =
                environment.rotated(glm::mat3(glm::rotate(glm::mat4(1.0F), glm::radians(turn), glm::vec3(0, 1, 0))));
        }
        result_.scene.environment = environment;
    }

    void readCamera(const json::Value* value) {
        if (!value) {
            if (faults_.hasErrors()) return;
            glm::vec3 low, high;
            bounds(result_.scene, true, low, high);
            const float aspect = static_cast<float>(result_.frame.width) / static_cast<float>(result_.frame.height);
            result_.scene.camera = frameBox(low, high, glm::vec3(0.35F, 0.12F, 1.0F), aspect);
            return;
        }
        Camera camera;
        camera.eye = toVector(*value->find("eye"));
        camera.target = toVector(*value->find("target"));
        camera.up = direction(*value, "up").value_or(camera.up);
        camera.verticalFov = glm::radians(numberOr(*value, "fov_deg", glm::degrees(camera.verticalFov)));
        camera.nearPlane = numberOr(*value, "near", camera.nearPlane);
        camera.farPlane = numberOr(*value, "far", camera.farPlane);
        if (glm::distance(camera.eye, camera.target) < 1e-6F) {
            fault("S006", value->place, "the camera's \"eye\" and \"target\" are the same point", "move one of them");
        }
        if (camera.nearPlane >= camera.farPlane) {
            fault("S007", value->place, "the camera's \"near\" is not nearer than \"far\"", "near < far, in metres");
        }
        result_.scene.camera = camera;
        result_.hasCamera = true;
    }

    void readFrame(const json::Value& value) {
        result_.frame.width = uintOr(value, "width", result_.frame.width);
        result_.frame.height = uintOr(value, "height", result_.frame.height);
        const json::Value* settings = value.find("settings");
        if (!settings || settings->members.empty()) return;
        auto tree = library_.passTree(result_.passTree);
        if (!tree) return adopt(tree.error(), settings->place);
        for (const json::Member& member : settings->members) {
            auto read = parseSetting(**tree, member.key, asText(member.value).value_or(""));
            if (read) {
                result_.frame.settings[member.key] = *read;
            } else {
                adopt(read.error(), member.place);
            }
        }
    }

    const json::Document& document_;
    Library& library_;
    fs::path directory_;
    std::map<std::string, Geometry> geometries_;
    SceneFile result_;
    Diagnostics faults_;
};

Result<json::Schema> readSchema(const Library& library) {
    const std::string path = (fs::path(library.dataDirectory()) / "schemas" / "scene.schema.json").string();
    const auto bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return json::Schema::parse({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace

Result<SceneFile> loadScene(const std::string& path, Library& library) {
    auto document = json::parseFile(path);
    if (!document) return tl::unexpected(document.error());
    const auto schema = readSchema(library);
    if (!schema) return tl::unexpected(schema.error());
    Diagnostics faults = schema->validate(*document);
    if (faults.hasErrors()) return tl::unexpected(std::move(faults));
    auto scene = SceneReader(*document, library).read();
    if (scene) scene->notes.append(faults);
    return scene;
}

Result<SceneFile> sceneFromAsset(const std::string& path, const std::string& material, float aspect, Library& library) {
    SceneFile file;
    auto geometry = parts::loadGeometry(path, 1, file.notes);
    if (!geometry) return tl::unexpected(geometry.error());
    auto parsed = library.material(material.empty() ? parts::defaultMaterial(*geometry) : material);
    if (!parsed) return tl::unexpected(parsed.error());
    file.notes.append(parsed->warnings);

    const std::string name = std::filesystem::path(path).stem().string();
    file.scene.objects.push_back({.name = name, .geometry = *geometry, .material = std::move(parsed->material)});
    glm::vec3 low, high;
    bounds(file.scene, true, low, high);
    file.scene.lights = portraitLights(low, high);
    file.scene.camera = frameBox(low, high, glm::vec3(0.35F, 0.12F, 1.0F), aspect);
    return file;
}

}  // namespace pelage::hair
