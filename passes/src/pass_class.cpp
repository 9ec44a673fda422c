// SPDX-License-Identifier: MIT
#include <pelage/passes/pass_class.hpp>

namespace pelage::passes {
namespace {

const PlanParameter* named(const std::vector<PlanParameter>& values, std::string_view name) {
    for (const PlanParameter& each : values) {
        if (each.name == name) return &each;
    }
    return nullptr;
}

}  // namespace

double PassParameters::number(std::string_view name) const {
    const PlanParameter* found = named(values_, name);
    return found ? found->number : 0;
}

const std::string& PassParameters::word(std::string_view name) const {
    static const std::string nothing;
    const PlanParameter* found = named(values_, name);
    return found ? found->word : nothing;
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
