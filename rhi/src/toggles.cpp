// SPDX-License-Identifier: MIT
#include "toggles.hpp"

#include "device_object.hpp"

namespace pelage::rhi {
namespace detail {

std::vector<std::string> Toggles::names() const {
    std::vector<std::string> on;
#define PELAGE_RHI_TOGGLE(word, driver, fixedIn) \
    if (word) on.emplace_back(#word);
#include "toggles.def"
    return on;
}

Result<Toggles> togglesFor(VkDriverId driver, std::uint32_t driverVersion, const std::vector<Toggle>& wanted,
                           const std::string& device) {
    Toggles toggles;
    std::string known;
#define PELAGE_RHI_TOGGLE(word, faulty, fixedIn)                    \
    toggles.word = driver == (faulty) && driverVersion < (fixedIn); \
    known += cat(known.empty() ? "" : ", ", #word);
#include "toggles.def"
    for (const auto& want : wanted) {
        bool found = false;
#define PELAGE_RHI_TOGGLE(word, driver, fixedIn) \
    if (want.name == #word) {                    \
        toggles.word = want.on;                  \
        found = true;                            \
    }
#include "toggles.def"
        if (!found)
            return invalid(ErrorCode::UnknownToggle,
                           cat(device, " is asked for the toggle \"", want.name, "\"; there are ", known, '.'));
    }
    return toggles;
}

}  // namespace detail

std::vector<std::string> Device::toggles() const {
    return object_ ? object_->toggles.names() : std::vector<std::string>();
}

}  // namespace pelage::rhi
