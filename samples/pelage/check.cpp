// SPDX-License-Identifier: MIT
// Reads authored files and prints everything found wrong, one line each, in the form editors understand.
#include "commands.hpp"
#include "data.hpp"
#include "generous_host.hpp"

#include <pelage/hair/functors.hpp>
#include <pelage/hair/library.hpp>
#include <pelage/hair/scene_file.hpp>

#include <cstdio>
#include <filesystem>

namespace pelage::app {

namespace {

template <class T>
Diagnostics faultsOf(const Checked<T>& read, const Diagnostics& warnings) {
    return read ? warnings : read.error();
}

Diagnostics checkPassTree(const std::string& path) {
    const auto tree = passes::PassTree::load(path);
    if (!tree) return tree.error();
    Diagnostics found = (*tree)->warnings();
    const auto plan = (*tree)->compile(generousHost(**tree, {640, 640, 1}));
    found.append(plan ? plan->warnings : plan.error());
    return found;
}

Diagnostics checkFile(const std::string& path, hair::Library& library) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        Diagnostics found;
        found.add({.code = "F001", .file = path, .text = "there is no such file", .hint = "check the path"});
        return found;
    }
    if (path.ends_with(".pass.json")) return checkPassTree(path);
    if (path.ends_with(".materialtype.json")) {
        const auto type = materials::MaterialType::load(path, hair::functorRegistry());
        return faultsOf(type, type ? (*type)->warnings() : Diagnostics());
    }
    if (path.ends_with(".material.json")) {
        const auto material = library.material(path.find('/') == std::string::npos ? "./" + path : path);
        return faultsOf(material, material ? material->warnings : Diagnostics());
    }
    if (path.ends_with(".scene.json")) {
        const auto scene = hair::loadScene(path, library);
        return faultsOf(scene, scene ? scene->notes : Diagnostics());
    }
    Diagnostics found;
    found.add({.code = "A050",
               .file = path,
               .text = "the ending says nothing of what this is",
               .hint = "expected *.pass.json, *.materialtype.json, *.material.json or *.scene.json"});
    return found;
}

}  // namespace

int check(const CheckOptions& options) {
    hair::Library library(dataDirectory());
    int result = exitOk;
    for (const std::string& file : options.files) {
        const Diagnostics found = checkFile(file, library);
        if (options.json) {
            std::fputs(found.jsonLines().c_str(), stdout);
        } else {
            std::fputs(found.text().c_str(), stderr);
        }
        if (found.hasErrors()) {
            result = exitFailed;
        } else if (!options.json) {
            std::printf("%s: %s\n", file.c_str(), found.empty() ? "clean" : "usable, with warnings");
        }
    }
    return result;
}

}  // namespace pelage::app
