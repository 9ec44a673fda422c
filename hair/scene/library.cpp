// SPDX-License-Identifier: MIT
#include <pelage/hair/functors.hpp>
#include <pelage/hair/library.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pelage::hair {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view materialEnding = ".material.json";
constexpr std::string_view typeEnding = ".materialtype.json";
constexpr std::string_view passEnding = ".pass.json";

bool isFile(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool looksLikePath(const std::string& name) {
    return name.find('/') != std::string::npos || name.ends_with(".json");
}

/// Names of the files in `directory` with this ending, without it, sorted.
std::vector<std::string> namesIn(const fs::path& directory, std::string_view ending) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(directory, error), end; !error && at != end; at.increment(error)) {
        std::string name = at->path().filename().string();
        if (name.ends_with(ending)) names.push_back(name.substr(0, name.size() - ending.size()));
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// "there is no material "brwon"", with the nearest of the names that there are.
Diagnostics unknownName(Code code, const char* what, const std::string& name, const fs::path& directory,
                        const std::vector<std::string>& known) {
    std::string hint;
    if (known.empty()) {
        hint = "the data directory has no " + directory.string() +
               "; set PELAGE_DATA to hair/data of the source tree of Pelage";
    } else if (const std::string_view nearest = nearestName(name, known); !nearest.empty()) {
        hint = "did you mean \"" + std::string(nearest) + "\"?";
    } else {
        hint = "known are " + joined(known) + "; or give a path that ends in .json";
    }
    return Diagnostic{
        .code = code, .text = std::string("there is no ") + what + " \"" + name + "\"", .hint = std::move(hint)};
}

}  // namespace

Library::Library(std::string dataDirectory) : Library(std::move(dataDirectory), functorRegistry()) {}

Library::Library(std::string dataDirectory, materials::FunctorRegistry functors)
    : directory_(std::move(dataDirectory)), functors_(std::move(functors)) {}

Result<std::shared_ptr<const materials::MaterialType>> Library::materialType(const std::string& name) {
    const fs::path directory = fs::path(directory_) / "types";
    fs::path path = name;
    if (!isFile(path)) {
        path = directory / path.filename();
        if (!name.ends_with(typeEnding)) path += typeEnding;
    }
    const std::string key = path.lexically_normal().string();
    if (const auto found = types_.find(key); found != types_.end()) return found->second;
    if (!isFile(path)) {
        return tl::unexpected(unknownName("L001", "material type", name, directory, namesIn(directory, typeEnding)));
    }
    auto type = materials::MaterialType::load(path.string(), functors_);
    if (type) types_.emplace(key, *type);
    return type;
}

Result<materials::Material::Parsed> Library::material(const std::string& nameOrPath) {
    fs::path path = nameOrPath;
    if (!looksLikePath(nameOrPath)) {
        const fs::path presets = fs::path(directory_) / "presets";
        path = presets / (nameOrPath + std::string(materialEnding));
        if (!isFile(path)) {
            // A type is a material with every value at its default.
            std::vector<std::string> known = presetNames();
            const auto types = namesIn(fs::path(directory_) / "types", typeEnding);
            if (std::find(types.begin(), types.end(), nameOrPath) != types.end()) {
                auto type = materialType(nameOrPath);
                if (!type) return tl::unexpected(type.error());
                return materials::Material::Parsed{materials::Material(*type), (*type)->warnings()};
            }
            known.insert(known.end(), types.begin(), types.end());
            return tl::unexpected(unknownName("L002", "material", nameOrPath, presets, known));
        }
    }
    return materials::Material::load(path.string(), typesFor(path.string()), parentSource());
}

materials::Material::TypeSource Library::typesFor(const std::string& materialFile) {
    return [this, beside = fs::path(materialFile).parent_path()](const std::string& type) {
        const fs::path near = beside / type;
        return materialType(isFile(near) ? near.string() : type);
    };
}

materials::Material::ParentSource Library::parentSource() const {
    return [presets = fs::path(directory_) / "presets"](const std::string& name, const std::string& file) {
        const fs::path near = fs::path(file).parent_path() / name;
        if (isFile(near) || !isFile(presets / name)) return near.string();
        return (presets / name).string();
    };
}

Result<std::shared_ptr<const passes::PassTree>> Library::passTree(const std::string& nameOrPath) {
    const fs::path templates = fs::path(directory_) / "frames";
    // What a tree includes and does not have beside it is one of the shipped frames.
    const auto shipped = [&](const std::string& name) { return (templates / name).string(); };
    if (looksLikePath(nameOrPath)) return passes::PassTree::load(nameOrPath, shipped);
    const fs::path path = templates / (nameOrPath + std::string(passEnding));
    if (!isFile(path)) {
        return tl::unexpected(unknownName("L003", "pass tree", nameOrPath, templates, namesIn(templates, passEnding)));
    }
    return passes::PassTree::load(path.string(), shipped);
}

std::vector<std::string> Library::presetNames() const {
    return namesIn(fs::path(directory_) / "presets", materialEnding);
}

}  // namespace pelage::hair
