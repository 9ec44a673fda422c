// SPDX-License-Identifier: MIT
// The linker: a Description and a host give a Plan. Each phase is a file of its own and reads what the one before made:
// conditions -> references and versions -> live passes and their order -> images -> load, store, lifetimes.
#pragma once

#include "check.hpp"

namespace pelage::passes {

constexpr std::uint32_t none = ~0U;

/// One state of an image: as lent or made (no producer), or as a pass left it.
struct Version {
    std::uint32_t resource = none;
    std::uint32_t producer = none;  // index of a pass
    std::uint32_t modifier = none;  // the pass that makes the next version
    std::string modifierSlot = {};
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
    bool enabled = true, live = false;
    std::string whyOff = {};
    std::vector<LinkedSlot> slots = {};
};

struct LinkedResource {
    PlanResource plan = {};
    const AttachmentDeclaration* attachment = nullptr;
    const ImportDeclaration* import = nullptr;
    std::uint32_t base = none;   // version 0
    std::uint32_t index = none;  // in the plan
};

struct Linker {
    const PassTree::Description& tree;
    const HostDescription& host;
    Reporter& reporter;

    Conditions conditions = {};
    std::vector<LinkedPass> passes = {};  // in the order of the file
    std::vector<Version> versions = {};
    std::vector<LinkedResource> resources = {};
    std::map<std::string, std::uint32_t> resourceOf = {};      // "att.X"
    std::map<std::string, std::uint32_t> exportVersions = {};  // by export
    std::vector<std::uint32_t> order = {};                     // live passes
    Plan plan = {};

    // link_conditions.cpp: settings, imports, views, which passes are on (H001..H004).
    void evaluateConditions();
    double number(const NumberOrSetting& value) const;    // pixels, samples, views
    double constant(const NumberOrSetting& value) const;  // an enum gives the index of its word
    // link_references.cpp: connections to versions of images (P033, P034, P044, P046).
    void resolveReferences();
    // schedule.cpp: culling and order (P046, P048).
    void schedule();
    // link_images.cpp: format, size, samples, layers, usage; what fits together (P037..P039, P042, D001, D002).
    void describeImages();
    // lifetimes.cpp: load and store, first and last use, shared memory.
    void finish();

    LinkedPass* passNamed(std::string_view name);
    const LinkedSlot* slotOf(const LinkedPass& pass, std::string_view name) const;
    std::uint32_t resource(const Reference& reference);
};

}  // namespace pelage::passes
