// SPDX-License-Identifier: MIT
// Texts for the tests: one tree that uses the whole grammar, and ways to edit and write JSON.
#pragma once

#include <pelage/base/json.hpp>
#include <pelage/passes/tree.hpp>

#include <functional>

namespace pelage::passes::test {

/// The text of a frame that hair ships: "hair_frame.pass.json".
std::string shippedText(const std::string& file);
/// A tree with settings of each type, imports, a template, all kinds of passes and no fault.
std::string wholeGrammar();
/// Another, with what the first leaves out: buffers, histories, a class, counts from a buffer.
std::string moreGrammar();
/// A host that knows the class and lends what moreGrammar() needs.
HostDescription moreHost();
/// `text` with the first `from` replaced by `to`; fails the test when `from` is not there.
std::string edited(std::string text, const std::string& from, const std::string& to);
/// 1-based line and column of the first `needle`.
json::Place placeOf(const std::string& text, const std::string& needle);

/// JSON text of a value, one member or element in a line.
std::string write(const json::Value& value, int indent = 0);
json::Value readJson(const std::string& text);
/// Every value of the tree below `root` with the path to it.
void forEachValue(json::Value& root, const std::function<void(json::Value& parent, std::size_t index)>& use);

/// A host that lends what wholeGrammar() needs: a frame of 64 x 48.
HostDescription host();
SettingValue flag(bool value);
SettingValue whole(std::uint32_t value);
SettingValue word(std::string value);

std::string codes(const Diagnostics& diagnostics);
std::vector<std::string> passNames(const Plan& plan);
const PlanResource* resource(const Plan& plan, const std::string& name);
const PlanSlot* slot(const Plan& plan, const std::string& pass, const std::string& slot);

}  // namespace pelage::passes::test
