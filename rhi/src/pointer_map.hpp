// SPDX-License-Identifier: MIT
// Numbers by address, for one scope at a time: emptying it costs nothing and it allocates only while it grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pelage::rhi::detail {

class PointerMap {
public:
    void clear() {
        ++round_;
        count_ = 0;
    }
    /// The number kept for `key`, and whether it is `fresh`, kept just now.
    std::pair<std::uint32_t, bool> insert(const void* key, std::uint32_t fresh) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = find(key);
        if (slot.round == round_) return {slot.number, false};
        slot = {key, round_, fresh};
        ++count_;
        return {fresh, true};
    }

private:
    struct Slot {
        const void* key = nullptr;
        std::uint64_t round = 0;
        std::uint32_t number = 0;
    };
    Slot& find(const void* key) {
        // Objects lie at multiples of 16; the multiplication spreads what is left.
        std::size_t i = (reinterpret_cast<std::uintptr_t>(key) >> 4) * 0x9E3779B97F4A7C15ULL >> shift_;
        while (slots_[i].round == round_ && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
        return slots_[i];
    }
    void grow() {
        std::vector<Slot> old = std::move(slots_);
        slots_.assign(old.empty() ? 16 : 2 * old.size(), Slot{});
        shift_ = old.empty() ? 60 : shift_ - 1;
        for (const Slot& slot : old)
            if (slot.round == round_) find(slot.key) = slot;
    }
    std::vector<Slot> slots_ = {};
    std::uint64_t round_ = 1;
    std::size_t count_ = 0;
    unsigned shift_ = 60;
};

}  // namespace pelage::rhi::detail
