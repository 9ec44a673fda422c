// SPDX-License-Identifier: MIT
// The linker: a Description and a host give a Plan. Each phase is a file of its own and reads what the one before made:
// conditions -> classes -> references and versions -> live passes and their order -> images -> load, store, lifetimes
// -> places in the heap. Names were made numbers when the tree was read; no phase walks the tree for each of its parts,
// and `visits` counts the steps, so that a test can see that twice the passes are twice the work.
#pragma once

#include "check.hpp"

#include <span>

namespace pelage::passes {

/// One state of an image or buffer: as lent or made (no producer), or as a pass left it.
struct Version {
    std::uint32_t resource = none;
    std::uint32_t producer = none;  // index of a pass
    std::uint32_t modifier = none;  // the pass that makes the next version, by its slot
    std::uint32_t modifierSlot = none;
    std::vector<std::uint32_t> readers = {};
    std::uint32_t number = 0;
};

struct LinkedSlot {
    const SlotDeclaration* says = nullptr;
    const Reference* source = nullptr;  // the connection that was taken
    std::uint32_t in = none, out = none;
    enum class State : std::uint8_t { Unknown, Resolving, Done, Failed } state = State::Unknown;
};

struct LinkedPass {
    const PassDeclaration* says = nullptr;
    PassKind kind = PassKind::Raster;     // of a class: what the class records
    const PassClassInfo* info = nullptr;  // of a class
    bool enabled = true, live = false;
    std::uint32_t firstSlot = 0, slotCount = 0;  // in Linker::slots
    std::uint32_t place = none;                  // in the order
};

struct LinkedResource {
    PlanResource plan = {};
    const AttachmentDeclaration* attachment = nullptr;  // also of its history
    const ImportDeclaration* import = nullptr;
    std::uint32_t base = none, last = none;  // versions
    std::uint32_t index = none;              // in the plan
};

struct LinkOptions {
    /// A seed for a random order among those that are valid. Empty: the walk from the exports. For tests of the claim
    /// that the results do not depend on the order.
    std::optional<std::uint32_t> order = {};
};

struct Linker {
    const PassTree::Description& tree;
    const HostDescription& host;
    const LinkOptions& options;
    Reporter& reporter;

    Conditions conditions = {};
    std::vector<LinkedPass> passes = {};  // in the order of the file
    std::vector<LinkedSlot> slots = {};
    std::vector<Version> versions = {};
    std::vector<LinkedResource> resources = {};
    std::vector<std::uint32_t> viewCounts = {};                                                    // by view
    std::vector<std::uint32_t> ofAttachment = {}, ofHistory = {}, ofImport = {}, ofConstant = {};  // resources
    std::vector<std::uint32_t> exportVersions = {};  // by export; none: absent
    std::vector<std::uint32_t> order = {};           // live passes
    std::uint64_t visits = 0;
    Plan plan = {};

    // link_conditions.cpp: settings, imports, views, which passes are on (P080..P084).
    void evaluateConditions();
    double number(const NumberOrSetting& value) const;    // pixels, samples, views
    double constant(const NumberOrSetting& value) const;  // an enum gives the index of its word
    std::string whyOff(const LinkedPass& pass) const;
    // link_classes.cpp: classes of the host and their parameters (P053..P055).
    void findClasses();
    std::vector<PlanParameter> parametersOf(const LinkedPass& pass);
    // link_references.cpp: connections to versions of images (P033, P034, P044, P046).
    void resolveReferences();
    // schedule.cpp: culling and order (P046, P048).
    void schedule();
    // link_images.cpp: format, size, samples, layers, usage; what fits together (P037..P039, P042, D001, D002).
    void describeImages();
    // lifetimes.cpp: load and store, first and last use; then place.cpp: bytes in the heap.
    void finish();
    void place();

    std::span<LinkedSlot> slotsOf(const LinkedPass& pass) { return {slots.data() + pass.firstSlot, pass.slotCount}; }
    std::span<const LinkedSlot> slotsOf(const LinkedPass& pass) const {
        return {slots.data() + pass.firstSlot, pass.slotCount};
    }
    std::uint32_t resource(const Reference& reference);
    LinkedResource& resourceOf(const LinkedSlot& slot) { return resources[versions[slot.in].resource]; }
};

/// The depth a slot clears to, for the host's convention.
float depthOf(const SlotDeclaration& slot, DepthConvention convention);

struct Linked {
    Result<Plan> plan;
    std::uint64_t visits = 0;
};
/// What PassTree::compile does.
Linked link(const PassTree::Description& tree, const HostDescription& host, const LinkOptions& options);

}  // namespace pelage::passes
