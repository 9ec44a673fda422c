// SPDX-License-Identifier: MIT
// A happens-before model of Vulkan's memory (Vulkan 1.3, "Synchronization and Cache Control"): it sees the accesses of
// commands and the barriers between them in the order of one queue, and says where an access is not ordered after,
// or does not see, what came before it. Written from the specification, without the library's own idea of barriers.
//
// On a CPU driver every barrier waits for everything, so a missing one shows in no picture, and Debian 12's validation
// layer does not see dynamic-rendering attachments nor read-modify-write chains of one buffer.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan.h>

namespace pelage::test {

/// One access to a range of one resource.
struct Touch {
    std::uint64_t object = 0;
    std::uint64_t begin = 0, end = ~0ULL;                        // bytes, of a buffer
    std::uint32_t mip = 0, mips = ~0U, layer = 0, layers = ~0U;  // of an image
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    bool write = false;
    bool needsContents = false;  // it must have been written before
    std::uint64_t scope = 0;  // accesses of one scope (the draws of a pass) are not ordered among themselves; 0: none
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  // in which the image must be; UNDEFINED: not asked
};

class HazardOracle {
public:
    void addBuffer(std::uint64_t id, std::uint64_t size, std::string name);
    /// `memory`, `offset`, `bytes`: where it lies; images that overlap there alias.
    void addImage(std::uint64_t id, std::uint32_t mips, std::uint32_t layers, std::string name);
    void bindImage(std::uint64_t id, std::uint64_t memory, std::uint64_t offset, std::uint64_t bytes);
    void rename(std::uint64_t id, std::string name);
    void remove(std::uint64_t id);

    void touch(const Touch& touch, const std::string& command);
    void barrier(const VkDependencyInfo& info, const std::string& where);
    /// The host reads what this submission wrote into the buffer.
    void hostReads(std::uint64_t buffer);

    const std::vector<std::string>& hazards() const { return hazards_; }
    void forgetHazards() { hazards_.clear(); }

private:
    static constexpr std::size_t stageBits = 40;
    /// Accesses that each stage is allowed to make without a further barrier.
    using Visible = std::array<VkAccessFlags2, stageBits>;
    struct Write {
        bool any = false, available = false;
        VkPipelineStageFlags2 stages = 0, chain = 0;  // chain: stages that wait for it
        VkAccessFlags2 access = 0;
        Visible visible = {};
        std::string by = {};
        std::uint64_t scope = 0;
    };
    struct Read {
        VkPipelineStageFlags2 stages = 0, chain = 0;
        std::string by = {};
        std::uint64_t scope = 0;
    };
    struct Cell {
        Write write;
        std::vector<Read> reads;
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        bool written = false;  // its contents were written
    };
    struct Span {
        std::uint64_t end = 0;
        Cell cell;
    };
    struct Resource {
        bool image = false;
        std::string name;
        std::uint32_t mips = 1, layers = 1;
        std::vector<Cell> cells;              // of an image: layer + mip * layers
        std::map<std::uint64_t, Span> spans;  // of a buffer
        std::uint64_t memory = 0, offset = 0, bytes = 0;
    };
    struct Scope {
        VkPipelineStageFlags2 from = 0, to = 0;
        VkAccessFlags2 made = 0, seen = 0;
    };
    void access(Cell& cell, const Touch& touch, const std::string& what, const std::string& command);
    static void apply(Cell& cell, const std::vector<Scope>& scopes);
    void transition(Resource& resource, Cell& cell, const VkImageMemoryBarrier2& barrier, const Scope& scope,
                    const std::vector<Scope>& memory, const std::string& where);
    void takeOver(std::uint64_t id, Resource& taker, const Scope& scope, const std::string& where);
    void hazard(std::string text);

    std::map<std::uint64_t, Resource> resources_;
    std::vector<std::string> hazards_;
};

}  // namespace pelage::test
