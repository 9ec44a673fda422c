// SPDX-License-Identifier: MIT
// From a checked JSON document to a Description. The schema has been applied, so kinds of values are right; what is
// read with these helpers falls back to a default when they are not, and never throws.
#pragma once

#include "description.hpp"

namespace pelage::passes {

/// A tree's text with all that it includes, laid together; its places know their files.
struct Source {
    json::Value root = {};
    std::vector<std::string> files = {}, onDisk = {};
};
/// Holds the document and what it includes against the schema (include.cpp). `disk`: it is a file, and others may lie
/// beside it. Reports P057..P059.
Source readSource(json::Document document, const TextReader& reader, const IncludePath& elsewhere, bool disk,
                  Diagnostics& out);

/// Reads all of a source that the schema accepts; reports what a schema cannot say.
std::shared_ptr<PassTree::Description> readDescription(const Source& source, Diagnostics& out);

/// The members "templates" and "passes" (reader_passes.cpp). Settings, imports, … of `description` are read already.
void readPasses(const json::Value& root, PassTree::Description& description, Reporter& reporter);

/// Faults that are there whatever the settings: names, references, what may follow what (check.cpp).
void checkDescription(PassTree::Description& description, Reporter& reporter);

/// Numbers for names, so that the linker compares no words (resolve_names.cpp). Only for a tree without fault.
void resolveNames(PassTree::Description& description);

std::string wordOf(const json::Value& object, std::string_view key, std::string otherwise = {});
bool flagOf(const json::Value& object, std::string_view key, bool otherwise);
Place placeOf(const json::Value& object, std::string_view key);  // of the value; of the object when absent
NumberOrSetting numberOrSetting(const json::Value& value);
std::uint32_t wholeNumber(double number, std::uint32_t otherwise = 0);
SlotAccess accessOf(const json::Value& object);
/// One reference or a list of them. Reports P015 for what is not a reference.
std::vector<Reference> readReferences(const json::Value& value, Reporter& reporter);

template <class F>
void forEachMember(const json::Value& object, std::string_view key, F&& use) {
    const json::Value* value = object.find(key);
    if (!value || !value->isObject()) return;
    for (const json::Member& member : value->members) use(member);
}

}  // namespace pelage::passes
