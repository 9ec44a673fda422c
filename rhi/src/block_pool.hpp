// SPDX-License-Identifier: MIT
// Memory for objects that come and go every frame: freed blocks of a size are kept for the next object of that size.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace pelage::rhi::detail {

class BlockPool {
public:
    BlockPool() = default;
    BlockPool(const BlockPool&) = delete;
    BlockPool& operator=(const BlockPool&) = delete;
    ~BlockPool() {
        for (const auto& [size, block] : free_) ::operator delete(block);
    }
    void* allocate(std::size_t size) {
        {
            const std::lock_guard lock(mutex_);
            for (auto& entry : free_)
                if (entry.first == size) {
                    void* block = entry.second;
                    entry = free_.back();
                    free_.pop_back();
                    return block;
                }
        }
        return ::operator new(size);
    }
    void release(void* block, std::size_t size) {
        const std::lock_guard lock(mutex_);
        if (free_.size() < 32)
            free_.emplace_back(size, block);
        else
            ::operator delete(block);
    }

private:
    std::mutex mutex_;
    std::vector<std::pair<std::size_t, void*>> free_;
};

/// For std::allocate_shared. Holds the pool, so that the last handle of all may outlive the device.
template <class T>
struct PoolAllocator {
    using value_type = T;
    explicit PoolAllocator(std::shared_ptr<BlockPool> from) : pool(std::move(from)) {}
    template <class U>
    PoolAllocator(const PoolAllocator<U>& other) : pool(other.pool) {}
    T* allocate(std::size_t count) { return static_cast<T*>(pool->allocate(count * sizeof(T))); }
    void deallocate(T* block, std::size_t count) { pool->release(block, count * sizeof(T)); }
    template <class U>
    bool operator==(const PoolAllocator<U>& other) const {
        return pool == other.pool;
    }
    std::shared_ptr<BlockPool> pool;
};

}  // namespace pelage::rhi::detail
