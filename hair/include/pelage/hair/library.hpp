// SPDX-License-Identifier: MIT
// Finds the shipped data files by name: material types, material presets, pass trees. A data directory holds
// types/, presets/, frames/ and schemas/; in the source tree it is hair/data.
#pragma once

#include <pelage/hair/scene.hpp>
#include <pelage/passes/tree.hpp>

#include <map>
#include <string>

namespace pelage::hair {

class Library {
public:
    explicit Library(std::string dataDirectory);
    /// With functors of the host's own beside those of hair: `functors` is functorRegistry() and what was added to it.
    Library(std::string dataDirectory, materials::FunctorRegistry functors);

    /// "hair.materialtype.json", or a path. Types are read once.
    Result<std::shared_ptr<const materials::MaterialType>> materialType(const std::string& name);
    /// A preset's name ("brown"), or a path to a *.material.json; a type beside the file is found first. Parents are
    /// looked for beside the file that names them, then among the presets.
    Result<materials::Material::Parsed> material(const std::string& nameOrPath);
    /// How material() finds types and parents, for others that read material files. Valid while the library is.
    materials::Material::TypeSource typesFor(const std::string& materialFile);
    materials::Material::ParentSource parentSource() const;
    /// "hair_frame" or a path to a *.pass.json.
    Result<std::shared_ptr<const passes::PassTree>> passTree(const std::string& nameOrPath);
    std::vector<std::string> presetNames() const;
    const std::string& dataDirectory() const { return directory_; }

private:
    std::string directory_;
    materials::FunctorRegistry functors_;
    std::map<std::string, std::shared_ptr<const materials::MaterialType>> types_;
};

}  // namespace pelage::hair
