// SPDX-License-Identifier: MIT
#include "bench_report.hpp"

#include "instructions.hpp"
#include "table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

namespace pelage::app {

namespace {

/// The value that switches an option off; nothing when it is off already or has no such value.
std::optional<double> offValue(const materials::Option& option, double current) {
    double off = 0;
    if (option.type == materials::ValueType::Enum) {
        const auto word = std::find(option.words.begin(), option.words.end(), "off");
        if (word == option.words.end()) return std::nullopt;
        off = static_cast<double>(word - option.words.begin());
    } else if (option.type != materials::ValueType::Bool) {
        return std::nullopt;
    }
    return current == off ? std::nullopt : std::optional(off);
}

const ModelResult* findModel(const BenchResult& result, const std::string& name) {
    for (const ModelResult& model : result.models) {
        if (model.name == name) return &model;
    }
    return nullptr;
}

double ratio(double value, double base) {
    return base > 0 ? value / base : 0;
}

double yardstickOf(const BenchResult& result, std::size_t pass) {
    const ModelResult* model = findModel(result, result.yardstick);
    return model && pass < model->passes.size() ? model->passes[pass].milliseconds : 0;
}

std::string timesText(const BenchResult& result) {
    std::vector<std::string> heads{"time / " + result.yardstick};
    for (const ModelResult& model : result.models) heads.push_back(model.name);
    heads.push_back(result.yardstick + " ms");
    Table table(heads);
    const ModelResult& first = result.models.front();
    for (std::size_t pass = 0; pass < first.passes.size(); ++pass) {
        std::vector<std::string> cells{first.passes[pass].name};
        const double base = yardstickOf(result, pass);
        for (const ModelResult& model : result.models) {
            const bool has = pass < model.passes.size();
            cells.push_back(has ? fixed(ratio(model.passes[pass].milliseconds, base), 3) : "-");
        }
        cells.push_back(fixed(base, 3));
        table.add(cells);
    }
    const ModelResult* yardstick = findModel(result, result.yardstick);
    const double base = yardstick ? yardstick->milliseconds : 0;
    std::vector<std::string> cells{"frame"};
    for (const ModelResult& model : result.models) cells.push_back(fixed(ratio(model.milliseconds, base), 3));
    cells.push_back(fixed(base, 3));
    table.add(cells);
    return table.text();
}

std::string fragmentsText(const BenchResult& result) {
    std::vector<std::string> heads{"fragments shaded"};
    for (const ModelResult& model : result.models) heads.push_back(model.name);
    Table table(heads);
    const ModelResult& first = result.models.front();
    for (std::size_t pass = 0; pass < first.passes.size(); ++pass) {
        std::vector<std::string> cells{first.passes[pass].name};
        for (const ModelResult& model : result.models) {
            cells.push_back(pass < model.passes.size() ? std::to_string(model.passes[pass].fragments) : "-");
        }
        table.add(cells);
    }
    return table.text();
}

nlohmann::json modelJson(const BenchResult& result, const ModelResult& model) {
    const ModelResult* yardstick = findModel(result, result.yardstick);
    nlohmann::json out = {{"name", model.name},
                          {"material", model.material},
                          {"medianMilliseconds", model.milliseconds},
                          {"ratio", ratio(model.milliseconds, yardstick ? yardstick->milliseconds : 0)}};
    for (std::size_t i = 0; i < model.passes.size(); ++i) {
        const PassResult& pass = model.passes[i];
        out["passes"].push_back({{"name", pass.name},
                                 {"medianMilliseconds", pass.milliseconds},
                                 {"ratio", ratio(pass.milliseconds, yardstickOf(result, i))},
                                 {"fragments", pass.fragments}});
    }
    return out;
}

}  // namespace

Result<void> countOptions(const std::string& model, materials::Material& material,
                          std::vector<InstructionResult>& results) {
    const materials::CompiledMaterial& compiled = material.compile();
    for (const auto& shader : compiled.shaders) {
        if (shader.use.name != "forward") continue;
        const std::string& file = shader.use.fragment;
        const auto code = hair::Renderer::shaderCode(file);
        if (code.empty()) return tl::unexpected(failure("A061", "there is no shader \"" + file + "\" in this build"));
        const auto count = [&](const std::string& variant,
                               const std::vector<rhi::ConstantEntry>& constants) -> Result<void> {
            auto counted = countInstructions(code, constants);
            if (!counted) return tl::unexpected(counted.error());
            results.push_back({.model = model, .shader = file, .variant = variant, .instructions = *counted});
            return {};
        };
        if (auto counted = count("as authored", shader.constants); !counted) return counted;
        for (const materials::Option& option : material.type().options()) {
            auto constants = shader.constants;
            const auto entry = std::find_if(constants.begin(), constants.end(),
                                            [&](const auto& each) { return each.name == option.name; });
            if (entry == constants.end()) continue;
            const auto off = offValue(option, entry->value);
            if (!off) continue;
            entry->value = *off;
            if (auto counted = count(option.name + " off", constants); !counted) return counted;
        }
    }
    return {};
}

std::string benchText(const BenchResult& result) {
    std::string text = result.scene + ", " + std::to_string(result.width) + "x" + std::to_string(result.height) + ", " +
                       result.device + " (" + result.driver + "), medians of " + std::to_string(result.repeats) +
                       " interleaved frames\n\n";
    text += timesText(result) + "\n" + fragmentsText(result) + "\n";
    Table attachments({"attachment", "format", "samples", "bytes"});
    for (const hair::AttachmentReport& attachment : result.models.front().attachments) {
        attachments.add(
            {attachment.name, attachment.format, std::to_string(attachment.samples), std::to_string(attachment.bytes)});
    }
    text += attachments.text() + "\n";
    Table instructions({"forward shader", "variant", "instructions", "of authored"});
    std::map<std::string, std::uint32_t> authored;
    for (const InstructionResult& row : result.instructions) {
        authored.emplace(row.model, row.instructions);
        instructions.add({row.model, row.variant, std::to_string(row.instructions),
                          fixed(ratio(row.instructions, authored[row.model]), 3)});
    }
    return text + instructions.text();
}

Result<void> writeBenchJson(const std::string& path, const BenchResult& result) {
    nlohmann::json out = {{"format", "pelage.bench/1"}, {"scene", result.scene},        {"device", result.device},
                          {"driver", result.driver},    {"width", result.width},        {"height", result.height},
                          {"repeats", result.repeats},  {"yardstick", result.yardstick}};
    for (const ModelResult& model : result.models) out["models"].push_back(modelJson(result, model));
    for (const hair::AttachmentReport& attachment : result.models.front().attachments) {
        out["attachments"].push_back({{"name", attachment.name},
                                      {"format", attachment.format},
                                      {"samples", attachment.samples},
                                      {"bytes", attachment.bytes}});
    }
    for (const InstructionResult& row : result.instructions) {
        out["instructions"].push_back({{"model", row.model},
                                       {"shader", row.shader},
                                       {"variant", row.variant},
                                       {"instructions", row.instructions}});
    }
    const std::string partial = path + ".part";
    std::error_code failed;
    {
        std::ofstream file(partial, std::ios::trunc);
        file << out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
        file.close();
        if (file) std::filesystem::rename(partial, path, failed);
        if (file && !failed) return {};
    }
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    return tl::unexpected(failure("A062", path + ": the results cannot be written; is its directory there?"));
}

}  // namespace pelage::app
