// SPDX-License-Identifier: MIT
#include <pelage/base/json.hpp>

namespace pelage::json {

const Member* Value::member(std::string_view key) const {
    for (const Member& candidate : members) {
        if (candidate.key == key) return &candidate;
    }
    return nullptr;
}

const Value* Value::find(std::string_view key) const {
    const Member* found = member(key);
    return found ? &found->value : nullptr;
}

}  // namespace pelage::json
