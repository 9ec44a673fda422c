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
#include <memory>
#include <set>

namespace pelage::app {

namespace {

Diagnostics checkPassTree(const std::string& path) {
    const auto tree = passes::PassTree::load(path);
    if (!tree) return tree.error();
    Diagnostics found = (*tree)->warnings();
    const auto plan = (*tree)->compile(generousHost(**tree, {640, 640, 1}));
    found.append(plan ? plan->warnings : plan.error());
    return found;
}

// Those of the pass trees among the files; without one, those of the tree that scenes have unless they say another.
std::vector<std::string> drawListsOf(const std::vector<std::string>& files, hair::Library& library) {
    std::vector<std::string> lists;
    bool any = false;
    for (const std::string& file : files) {
        if (!file.ends_with(".pass.json")) continue;
        any = true;
        const auto tree = passes::PassTree::load(file);
        if (!tree) continue;
        const auto more = (*tree)->drawLists();
        lists.insert(lists.end(), more.begin(), more.end());
    }
    if (any) return lists;
    const auto tree = library.passTree(hair::SceneFile().passTree);
    return tree ? (*tree)->drawLists() : lists;
}

Diagnostics checkScene(const std::string& path, hair::Library& library) {
    auto scene = hair::loadScene(path, library);
    if (!scene) return scene.error();
    Diagnostics found = scene->notes;
    const auto tree = library.passTree(scene->passTree);
    if (!tree) {
        found.append(tree.error());
        return found;
    }
    std::set<std::shared_ptr<const materials::MaterialType>> types;
    for (const hair::Object& object : scene->scene.objects) {
        const auto& type = object.material.sharedType();
        if (types.insert(type).second) found.append(type->unknownDrawLists((*tree)->drawLists()));
    }
    return found;
}

Diagnostics checkFile(const std::string& path, const std::vector<std::string>& drawLists, hair::Library& library) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        Diagnostics found;
        found.add({.code = "F001", .file = path, .text = "there is no such file", .hint = "check the path"});
        return found;
    }
    if (path.ends_with(".pass.json")) return checkPassTree(path);
    if (path.ends_with(".materialtype.json")) {
        const auto type = materials::MaterialType::load(path, hair::functorRegistry());
        if (!type) return type.error();
        Diagnostics found = (*type)->warnings();
        found.append((*type)->unknownDrawLists(drawLists));
        return found;
    }
    if (path.ends_with(".material.json")) {
        const auto material = library.material(path.find('/') == std::string::npos ? "./" + path : path);
        if (!material) return material.error();
        Diagnostics found = material->warnings;
        found.append(material->material.type().unknownDrawLists(drawLists));
        return found;
    }
    if (path.ends_with(".scene.json")) return checkScene(path, library);
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
    const std::vector<std::string> drawLists = drawListsOf(options.files, library);
    int result = exitOk;
    for (const std::string& file : options.files) {
        const Diagnostics found = checkFile(file, drawLists, library);
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
