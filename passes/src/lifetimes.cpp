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
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < image.mipLevels; ++level) {
        const rhi::Extent3D extent = levelExtent(image.extent, image.is3D, level);
        texels += std::uint64_t{extent.width} * extent.height * (image.is3D ? extent.depthOrArrayLayers : image.layers);
    }
    return texel * texels * image.samples;
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
        written_.assign(plan_.resources.size(), 0);
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
        if (linked.kind == PassKind::Raster && says.passClass.empty()) made.passClass = drawListClass;
        made.forEachLayer = says.forEachLayer;
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
            made.indirectOffset = says.indirectOffset;
            made.slots.push_back(slot(linkedSlot));
            const PlanSlot& own = made.slots.back();
            if (own.resource == none) continue;
            PlanResource& image = plan_.resources[own.resource];
            image.firstPass = std::min(image.firstPass, passIndex);
            image.lastPass = passIndex;
            if (own.makes != none) image.versions = std::max(image.versions, own.makes + 1);
            if (linkedSlot.says->name == says.dispatchLike) {
                const rhi::Extent3D extent = levelExtent(image.extent, image.is3D, own.level == none ? 0 : own.level);
                const std::uint32_t sides[3] = {extent.width, extent.height,
                                                image.is3D ? extent.depthOrArrayLayers : image.layers};
                for (std::size_t i = 0; i < 3; ++i)
                    made.dispatch[i] = (sides[i] + says.threads[i] - 1) / says.threads[i];
            }
        }
        // What a pass writes is there for those after it.
        for (const PlanSlot& slot : made.slots) {
            if (slot.resource != none && slot.access != SlotAccess::Read)
                written_[slot.resource] |= levelMask(plan_.resources[slot.resource], slot.level);
        }
        plan_.passes.push_back(std::move(made));
    }

    static std::uint32_t levelMask(const PlanResource& image, std::uint32_t level) {
        return level == none ? (1U << image.mipLevels) - 1 : 1U << level;
    }

    // Only images of ours with several levels can be there in part.
    void wholeEnough(const LinkedSlot& linked, const PlanSlot& made) const {
        const PlanResource& image = plan_.resources[made.resource];
        if (image.mipLevels == 1 || image.kind != PlanResource::Kind::Transient) return;
        const std::uint32_t lacking = levelMask(image, made.level) & ~written_[made.resource];
        if (lacking == 0) return;
        std::uint32_t first = 0;
        while ((lacking >> first & 1U) == 0) ++first;
        const SlotDeclaration& says = *linked.says;
        linker_.reporter.error(linked.source ? linked.source->place : says.place, "P061",
                               "slot '" + says.name + "' reads mip level " + std::to_string(first) + " of '" +
                                   image.name + "', which no pass before it writes",
                               made.level == none ? "name the \"level\" that it reads, or write the others"
                                                  : "connect it to the pass that writes that level");
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
        // An image of ours that no pass has written begins here; a lent one has what the host put into it.
        const PlanResource& image = plan_.resources[made.resource];
        if (image.mipLevels > 1) made.level = levelOf(says);
        const bool ours = image.kind == PlanResource::Kind::Transient;
        const bool fresh = image.mipLevels > 1 && (levelMask(image, made.level) & written_[made.resource]) == 0;
        const bool begins = ours && (version.number == 0 || fresh);
        if (says.access == SlotAccess::Write || (says.access == SlotAccess::ReadWrite && begins)) {
            made.load = says.hasClear ? rhi::LoadOp::Clear : rhi::LoadOp::DontCare;
        } else {
            made.reads = version.number;
            wholeEnough(linked, made);
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
    std::vector<std::uint32_t> written_ = {};  // by resource: the mip levels, one bit each, that a pass has written
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
