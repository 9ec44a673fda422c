// SPDX-License-Identifier: MIT
// libFuzzer entry: the first byte says whether the rest is a material type or a material of a small fixed type.
#include <pelage/materials/material.hpp>
#include <pelage/materials/migrate.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace pelage;
using namespace pelage::materials;

constexpr std::string_view typeText = R"({ "format": "pelage.materialtype/1", "version": 3, "name": "Small",
  "versionUpdates": [{ "to": 2, "actions": [{ "op": "rename", "from": "g.old", "to": "g.ior" },
                                            { "op": "remap", "property": "g.ior", "scale": 0.5, "offset": 1 }] },
                     { "to": 3, "actions": [{ "op": "remove", "property": "g.gone" },
                                            { "op": "setValue", "property": "g.mode", "value": "b" }] }],
  "groups": [{ "name": "g", "properties": [
    { "name": "ior", "type": "float", "default": 1.5, "min": 1, "max": 3 },
    { "name": "color", "type": "color", "space": "srgb", "default": [1, 1, 1], "connect": { "input": "color" } },
    { "name": "mode", "type": "enum", "values": ["a", "b"], "default": "a", "connect": { "option": "mode" } }] }],
  "inputs": { "f0": "float", "color": "color" }, "options": { "mode": { "values": ["a", "b"], "default": "a" } },
  "shaders": { "main": { "drawList": "forward", "vertex": "a.vert", "options": "*" } },
  "functors": [{ "id": "f", "type": "FresnelFromIor", "in": { "ior": "g.ior" }, "out": { "f0": "input.f0" } }] })";

void use(Material& material) {
    for (const auto& input : material.compile().inputs) {
        for (const float number : input.value.number) {
            if (!std::isfinite(number)) std::abort();
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const FunctorRegistry registry = FunctorRegistry::standard();
    if (data[0] % 2 == 0) {
        const auto type = MaterialType::parse(text, "fuzz", registry);
        if (!type) return 0;
        Material material(*type);
        use(material);
        return 0;
    }
    const auto types = [&](const std::string&) { return MaterialType::parse(typeText, "small", registry); };
    // A fuzzer must not wander through the file system: no parent is there.
    const auto parents = [](const std::string&, const std::string&) { return std::string("no/such/parent"); };
    auto parsed = Material::parse(text, "fuzz", types, parents);
    if (!parsed) {
        const auto type = types("");
        if (!type) std::abort();
        Material material(*type);
        material.setFromText("g.ior", text);
        material.setFromText("g.color", text);
        material.setFromText("g.mode", text);
        use(material);
        return 0;
    }
    use(parsed->material);
    const auto migrated = migrate(text, "fuzz", types, parents);
    if (!migrated) std::abort();
    const auto again = Material::parse(migrated->text, "fuzz", types, parents);
    if (!again) std::abort();
    for (const Property& property : again->material.type().properties()) {
        if (!(*again->material.get(property.id) == *parsed->material.get(property.id))) std::abort();
    }
    return 0;
}
