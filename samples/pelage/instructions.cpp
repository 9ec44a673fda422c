// SPDX-License-Identifier: MIT
#include "instructions.hpp"

#include <spirv-tools/optimizer.hpp>

#include <cstring>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace pelage::app {

namespace {

// Numbers of the SPIR-V specification (sections 2.3, 3.49).
constexpr std::size_t headerWords = 5;
constexpr std::uint32_t opName = 5, opTypeFloat = 22, opSpecConstant = 50, opFunction = 54, opFunctionParameter = 55,
                        opFunctionEnd = 56, opDecorate = 71, opLabel = 248;
constexpr std::uint32_t decorationSpecId = 1;

/// Calls visit(opcode, operands) for each instruction; stops at a word that cannot be one.
template <class Visit>
void forEachInstruction(std::span<const std::uint32_t> code, Visit&& visit) {
    for (std::size_t at = headerWords; at < code.size();) {
        const std::size_t words = code[at] >> 16U;
        if (words == 0 || at + words > code.size()) return;
        visit(code[at] & 0xffffU, code.subspan(at + 1, words - 1));
        at += words;
    }
}

/// What the constants are called and how their bits are read.
struct SpecConstants {
    std::unordered_map<std::string, std::uint32_t> idByName = {};
    std::unordered_set<std::uint32_t> floats = {};  // SpecIds
};

SpecConstants findSpecConstants(std::span<const std::uint32_t> code) {
    std::unordered_map<std::uint32_t, std::string> names;
    std::unordered_map<std::uint32_t, std::uint32_t> specIds;
    std::unordered_set<std::uint32_t> floatTypes, floatResults;
    forEachInstruction(code, [&](std::uint32_t opcode, std::span<const std::uint32_t> words) {
        if (opcode == opName && words.size() > 1) {
            const char* text = reinterpret_cast<const char*>(words.data() + 1);
            names[words[0]] = std::string(text, strnlen(text, (words.size() - 1) * 4));
        } else if (opcode == opDecorate && words.size() > 2 && words[1] == decorationSpecId) {
            specIds[words[0]] = words[2];
        } else if (opcode == opTypeFloat && !words.empty()) {
            floatTypes.insert(words[0]);
        } else if (opcode == opSpecConstant && words.size() > 1 && floatTypes.contains(words[0])) {
            floatResults.insert(words[1]);
        }
    });
    SpecConstants found;
    for (const auto& [result, specId] : specIds) {
        if (const auto name = names.find(result); name != names.end()) found.idByName[name->second] = specId;
        if (floatResults.contains(result)) found.floats.insert(specId);
    }
    return found;
}

std::uint32_t bitsOf(double value, bool isFloat) {
    if (!isFloat) return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    const float narrow = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &narrow, sizeof bits);
    return bits;
}

std::uint32_t countInFunctions(std::span<const std::uint32_t> code) {
    std::uint32_t count = 0;
    bool inside = false;
    forEachInstruction(code, [&](std::uint32_t opcode, std::span<const std::uint32_t>) {
        if (opcode == opFunction) inside = true;
        if (opcode == opFunctionEnd) inside = false;
        const bool frame = opcode == opFunction || opcode == opFunctionParameter || opcode == opLabel;
        if (inside && !frame) ++count;
    });
    return count;
}

}  // namespace

Result<std::uint32_t> countInstructions(std::span<const std::uint32_t> code,
                                        const std::vector<rhi::ConstantEntry>& constants) {
    const SpecConstants known = findSpecConstants(code);
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> bits;
    for (const rhi::ConstantEntry& constant : constants) {
        const auto found = known.idByName.find(constant.name);
        if (found == known.idByName.end()) continue;
        bits[found->second] = {bitsOf(constant.value, known.floats.contains(found->second))};
    }

    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
    std::string problem;
    optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
        if (level <= SPV_MSG_ERROR && problem.empty()) problem = text;
    });
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(bits))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPerformancePasses()
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateCompactIdsPass());
    std::vector<std::uint32_t> optimized;
    if (!optimizer.Run(code.data(), code.size(), &optimized)) {
        return tl::unexpected(failure("A060", "SPIRV-Tools cannot optimise the shader: " + problem));
    }
    return countInFunctions(optimized);
}

}  // namespace pelage::app
