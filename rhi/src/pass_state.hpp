// SPDX-License-Identifier: MIT
// What an encoder keeps while it records: the uses of the scope it is in, and what the pass has set so far.
#pragma once

#include "objects.hpp"
#include "packets.hpp"
#include "pointer_map.hpp"

namespace pelage::rhi::detail {

/// Merges the uses of one scope and finds conflicts.
class ScopeBuilder {
public:
    /// The use that conflicts, or null.
    const Use* add(const Use& use);
    /// Moves the merged uses to the end of `to`; overlapping parts of one texture are split first.
    packet::Scope take(std::vector<Use>& to);
    void clear();

private:
    std::vector<Use> uses_;
    std::vector<std::uint32_t> heads_;  // the first use of each object, in the order of use
    PointerMap first_;
};

/// "draw #3", spelled out only when something is wrong.
struct CommandName {
    std::string_view word = {};
    std::optional<std::uint32_t> number = {};
    std::string text() const { return number ? cat(word, *number) : std::string(word); }
    friend std::ostream& operator<<(std::ostream& out, const CommandName& name) { return out << name.text(); }
};

struct BoundGroup {
    BindGroupObject* group = nullptr;  // kept by the recording, like everything below
    std::vector<std::uint32_t> offsets;
    bool dirty = false;
};

/// What a pass has set so far.
struct PassState {
    PipelineObject* pipeline = nullptr;
    std::vector<BoundGroup> groups;
    PipelineLayoutObject* boundLayout = nullptr;
    std::array<std::byte, 256> push = {};
    bool pushDirty = true, groupsChanged = true;
    struct Vertex {
        BufferObject* buffer = nullptr;
        std::uint64_t offset = 0;
    };
    std::vector<Vertex> vertexBuffers;
    Vertex index;
    IndexFormat indexFormat = IndexFormat::Uint32;
    std::uint32_t commands = 0;  // draws or dispatches, for messages
    std::uint32_t debugGroups = 0;
    std::size_t scopePacket = 0;
    packet::Scope lastDispatchScope;
    PointerMap merged;  // groups whose uses are in the scope
    QuerySetObject* timestamps = nullptr;
    std::optional<std::uint32_t> endTimestamp;
    std::string label;
    /// As at the beginning of a pass, but with the memory it has.
    void reset();
};

}  // namespace pelage::rhi::detail
