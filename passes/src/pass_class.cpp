// SPDX-License-Identifier: MIT
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

const PlanParameter* named(const std::vector<PlanParameter>& values, std::string_view name) {
    for (const PlanParameter& each : values) {
        if (each.name == name) return &each;
    }
    return nullptr;
}

}  // namespace

std::optional<double> constantOf(const Plan& plan, const PlanPass& pass, const std::string& name) {
    if (const auto found = pass.constants.find(name); found != pass.constants.end()) return found->second;
    for (const PlanSlot& slot : pass.slots) {
        if (slot.bind.empty()) continue;
        const bool connected = slot.resource != ~0U;
        if (name == slot.bind + "_present") return connected ? 1 : 0;
        if (name == slot.bind + "_samples") return connected ? plan.resources[slot.resource].samples : 1;
    }
    return std::nullopt;
}

double PassParameters::number(std::string_view name) const {
    const PlanParameter* found = named(values_, name);
    return found ? found->number : 0;
}

const std::string& PassParameters::word(std::string_view name) const {
    static const std::string nothing;
    const PlanParameter* found = named(values_, name);
    return found ? found->word : nothing;
}

rhi::ProgrammableStage PassSetup::stage(const rhi::ShaderModule& module) const {
    rhi::ProgrammableStage made{.module = module};
    for (const rhi::SpecConstant& constant : module.reflection().specConstants) {
        asked.names.push_back(constant.name);
        if (const std::optional<double> value = constantOf(plan, pass, constant.name))
            made.constants.push_back({constant.name, *value});
    }
    return made;
}

const std::map<std::string, double>& PassSetup::constants() const {
    asked.all = true;
    return pass.constants;
}

bool PassClassRegistry::add(PassClass made) {
    if (made.info.name.empty() || !made.create || find(made.info.name)) return false;
    classes_.push_back(std::move(made));
    return true;
}

const PassClass* PassClassRegistry::find(std::string_view name) const {
    for (const PassClass& each : classes_) {
        if (each.info.name == name) return &each;
    }
    return nullptr;
}

std::vector<PassClassInfo> PassClassRegistry::infos() const {
    std::vector<PassClassInfo> infos;
    for (const PassClass& each : classes_) infos.push_back(each.info);
    return infos;
}

}  // namespace pelage::passes
