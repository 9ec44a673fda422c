// SPDX-License-Identifier: MIT
// Passes and images as the plan shows them, with load and store and lifetimes.
#include "link.hpp"

#include <algorithm>

namespace pelage::passes {
namespace {

std::uint64_t bytesOf(const PlanResource& image) {
    std::uint64_t texel = rhi::bytesPerTexel(image.format);
    if (image.format == rhi::TextureFormat::Depth24PlusStencil8) texel = 4;
    if (image.format == rhi::TextureFormat::Depth32FloatStencil8) texel = 8;
    return texel * image.extent.width * image.extent.height * image.layers * image.samples;
}

class Finisher {
public:
    explicit Finisher(Linker& linker) : linker_(linker), plan_(linker.plan) {}

    void run() {
        for (LinkedResource& resource : linker_.resources) {
            if (resource.index == none) continue;
            PlanResource& image = plan_.resources[resource.index];
            image = std::move(resource.plan);
            image.firstPass = none;
            if (!image.isBuffer) image.bytes = bytesOf(image);
        }
        plan_.passes.reserve(linker_.order.size());
        for (const std::uint32_t index : linker_.order) pass(linker_.passes[index]);
        exported_.assign(plan_.resources.size(), false);
        for (std::size_t i = 0; i < linker_.exportVersions.size(); ++i) {
            const std::uint32_t version = linker_.exportVersions[i];
            if (version == none) continue;
            const std::uint32_t index = linker_.resources[linker_.versions[version].resource].index;
            plan_.exports[linker_.tree.exports[i].name] = index;
            plan_.resources[index].lastPass = lastPass();
            exported_[index] = true;
        }
        stores();
    }

private:
    std::uint32_t lastPass() const { return static_cast<std::uint32_t>(plan_.passes.size()) - 1; }

    void pass(const LinkedPass& linked) {
        const PassDeclaration& says = *linked.says;
        PlanPass made{.name = says.name, .drawList = says.drawList, .view = says.view, .kind = linked.kind};
        made.passClass = says.passClass;
        made.forEachLayer = says.forEachLayer;
        made.sort = says.sort;
        const bool first = !says.shader.when || says.shader.when->evaluate(linker_.conditions);
        made.shader = first ? says.shader.file : says.shader.otherwise;
        if (linked.info) made.parameters = linker_.parametersOf(linked);
        for (const ConstantDeclaration& constant : says.constants)
            made.constants[constant.name] = linker_.constant(constant.value);
        std::copy(std::begin(says.dispatch), std::end(says.dispatch), std::begin(made.dispatch));
        const auto passIndex = static_cast<std::uint32_t>(plan_.passes.size());
        made.slots.reserve(linked.slotCount);
        for (const LinkedSlot& linkedSlot : linker_.slotsOf(linked)) {
            ++linker_.visits;
            if (!says.dispatchIndirect.empty() && linkedSlot.says->name == says.dispatchIndirect)
                made.indirect = static_cast<std::uint32_t>(made.slots.size());
            made.slots.push_back(slot(linkedSlot));
            const PlanSlot& own = made.slots.back();
            if (own.resource == none) continue;
            PlanResource& image = plan_.resources[own.resource];
            image.firstPass = std::min(image.firstPass, passIndex);
            image.lastPass = passIndex;
            if (own.makes != none) image.versions = std::max(image.versions, own.makes + 1);
            if (linkedSlot.says->name == says.dispatchLike) {
                const std::uint32_t sides[3] = {image.extent.width, image.extent.height, image.layers};
                for (std::size_t i = 0; i < 3; ++i)
                    made.dispatch[i] = (sides[i] + says.threads[i] - 1) / says.threads[i];
            }
        }
        plan_.passes.push_back(std::move(made));
    }

    PlanSlot slot(const LinkedSlot& linked) const {
        const SlotDeclaration& says = *linked.says;
        PlanSlot made{.name = says.name, .bind = says.bind, .access = says.access, .use = says.use};
        made.blendPremultiplied = says.blendPremultiplied;
        made.depthTestAlways = says.depthTestAlways;
        made.clear = says.clear;
        made.clearDepth = depthOf(says, plan_.depth);
        if (linked.in == none) return made;
        const Version& version = linker_.versions[linked.in];
        made.resource = linker_.resources[version.resource].index;
        if (version.producer != none) made.producer = linker_.passes[version.producer].place;
        if (linked.out != none) made.makes = linker_.versions[linked.out].number;
        // An image of ours that nobody has written begins here; a lent one has what the host put into it.
        const bool begins = version.number == 0 && plan_.resources[made.resource].kind == PlanResource::Kind::Transient;
        if (says.access == SlotAccess::Write || (says.access == SlotAccess::ReadWrite && begins)) {
            made.load = says.hasClear ? rhi::LoadOp::Clear : rhi::LoadOp::DontCare;
        } else {
            made.reads = version.number;
        }
        return made;
    }

    // What no later pass, no export and no next frame looks at need not leave the tile.
    void stores() {
        for (std::uint32_t index = 0; index < plan_.passes.size(); ++index) {
            for (PlanSlot& slot : plan_.passes[index].slots) {
                if (slot.resource == none || slot.access == SlotAccess::Read) continue;
                const PlanResource& image = plan_.resources[slot.resource];
                const bool seen = image.lastPass > index || image.kind == PlanResource::Kind::Import ||
                                  image.partner != none || exported_[slot.resource];
                slot.store = seen ? rhi::StoreOp::Store : rhi::StoreOp::Discard;
            }
        }
    }

    Linker& linker_;
    Plan& plan_;
    std::vector<bool> exported_ = {};
};

}  // namespace

float depthOf(const SlotDeclaration& slot, DepthConvention convention) {
    using Depth = SlotDeclaration::DepthClear;
    const float far = convention == DepthConvention::Reversed ? 0.0F : 1.0F;
    return slot.depthClear == Depth::Far ? far : slot.depthClear == Depth::Near ? 1.0F - far : slot.depthValue;
}

void Linker::finish() {
    Finisher(*this).run();
    place();
}

Linked link(const PassTree::Description& tree, const HostDescription& host, const LinkOptions& options) {
    Diagnostics out;
    Reporter reporter(tree.files, out);
    Linker linker{.tree = tree, .host = host, .options = options, .reporter = reporter};
    linker.evaluateConditions();
    linker.findClasses();
    if (!out.hasErrors()) linker.resolveReferences();
    if (!out.hasErrors()) linker.schedule();
    if (!out.hasErrors()) linker.describeImages();
    if (!out.hasErrors()) linker.finish();
    out.sortByPlace();
    if (out.hasErrors()) return {tl::unexpected(std::move(out)), linker.visits};
    linker.plan.warnings = std::move(out);
    return {std::move(linker.plan), linker.visits};
}

}  // namespace pelage::passes
