// SPDX-License-Identifier: MIT
// The last phase: passes and images as the plan shows them, with load and store, lifetimes and shared memory.
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
        for (const LinkedResource& resource : linker_.resources) {
            if (resource.index == none) continue;
            PlanResource& image = plan_.resources[resource.index];
            image = resource.plan;
            image.firstPass = none;
            image.bytes = image.isBuffer ? 0 : bytesOf(image);
        }
        for (const std::uint32_t index : linker_.order) pass(linker_.passes[index]);
        for (const auto& [name, version] : linker_.exportVersions) {
            const std::uint32_t index = linker_.resources[linker_.versions[version].resource].index;
            plan_.exports[name] = index;
            plan_.resources[index].lastPass = lastPass();
        }
        stores();
        share();
    }

private:
    std::uint32_t lastPass() const { return static_cast<std::uint32_t>(plan_.passes.size()) - 1; }

    void pass(const LinkedPass& linked) {
        const PassDeclaration& says = *linked.says;
        PlanPass made{.name = says.name, .drawList = says.drawList, .view = says.view, .kind = says.kind};
        made.forEachLayer = says.forEachLayer;
        made.sort = says.sort;
        const bool first = !says.shader.when || says.shader.when->evaluate(linker_.conditions);
        made.shader = first ? says.shader.file : says.shader.otherwise;
        for (const ConstantDeclaration& constant : says.constants)
            made.constants[constant.name] = linker_.constant(constant.value);
        std::copy(std::begin(says.dispatch), std::end(says.dispatch), std::begin(made.dispatch));
        const auto passIndex = static_cast<std::uint32_t>(plan_.passes.size());
        for (const LinkedSlot& linkedSlot : linked.slots) {
            made.slots.push_back(slot(linkedSlot));
            const std::uint32_t at = made.slots.back().resource;
            if (at == none) continue;
            PlanResource& image = plan_.resources[at];
            image.firstPass = std::min(image.firstPass, passIndex);
            image.lastPass = passIndex;
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
        const float far = plan_.depth == DepthConvention::Reversed ? 0.0F : 1.0F;
        using Depth = SlotDeclaration::DepthClear;
        made.clearDepth = says.depthClear == Depth::Far    ? far
                          : says.depthClear == Depth::Near ? 1.0F - far
                                                           : says.depthValue;
        if (linked.in == none) return made;
        const Version& version = linker_.versions[linked.in];
        made.resource = linker_.resources[version.resource].index;
        // An image of ours that nobody has written begins here; a lent one has what the host put into it.
        const bool begins = version.number == 0 && plan_.resources[made.resource].kind == PlanResource::Kind::Transient;
        if (says.access == SlotAccess::Write || (says.access == SlotAccess::ReadWrite && begins)) {
            made.load = says.hasClear ? rhi::LoadOp::Clear : rhi::LoadOp::DontCare;
        }
        return made;
    }

    // What no later pass and no export looks at need not leave the tile.
    void stores() {
        for (std::uint32_t index = 0; index < plan_.passes.size(); ++index) {
            for (PlanSlot& slot : plan_.passes[index].slots) {
                if (slot.resource == none || slot.access == SlotAccess::Read) continue;
                const PlanResource& image = plan_.resources[slot.resource];
                const bool seen =
                    image.lastPass > index || image.kind == PlanResource::Kind::Import || isExported(slot.resource);
                slot.store = seen ? rhi::StoreOp::Store : rhi::StoreOp::Discard;
            }
        }
    }

    bool isExported(std::uint32_t resource) const {
        return std::any_of(plan_.exports.begin(), plan_.exports.end(),
                           [&](const auto& each) { return each.second == resource; });
    }

    // Whole textures are shared between images of one shape whose lifetimes do not overlap. An export is read after the
    // frame, so its texture is its own.
    void share() {
        struct Allocation {
            const PlanResource* shape;
            std::uint32_t lastPass;
            bool open;
            std::vector<std::uint32_t> users;
        };
        std::vector<Allocation> pool;
        for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
            PlanResource& image = plan_.resources[i];
            if (image.kind != PlanResource::Kind::Transient) continue;
            const bool open = !isExported(i);
            const auto fits = [&](const Allocation& each) {
                return open && each.open && each.lastPass < image.firstPass && each.shape->format == image.format &&
                       each.shape->extent == image.extent && each.shape->samples == image.samples;
            };
            auto found = std::find_if(pool.begin(), pool.end(), fits);
            if (found == pool.end()) {
                pool.push_back({&image, 0, open, {}});
                found = pool.end() - 1;
                plan_.allocatedBytes += image.bytes;
            }
            found->lastPass = image.lastPass;
            found->users.push_back(i);
            image.allocation = static_cast<std::uint32_t>(found - pool.begin());
        }
        plan_.allocations = static_cast<std::uint32_t>(pool.size());
        for (const Allocation& each : pool) {
            rhi::TextureUsage usage = rhi::TextureUsage::None;
            for (const std::uint32_t user : each.users) usage = usage | plan_.resources[user].usage;
            for (const std::uint32_t user : each.users) plan_.resources[user].usage = usage;
        }
    }

    Linker& linker_;
    Plan& plan_;
};

}  // namespace

void Linker::finish() {
    Finisher(*this).run();
}

}  // namespace pelage::passes
