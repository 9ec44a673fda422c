// SPDX-License-Identifier: MIT
// Format, size, samples, layers and usage of every image that a live pass touches, and whether they fit together.
#include "link.hpp"

#include <cmath>

namespace pelage::passes {
namespace {

constexpr std::uint32_t largestSide = 32768;

bool isTarget(const SlotDeclaration& slot) {
    return slot.use == SlotUse::Color || slot.use == SlotUse::Depth;
}

rhi::TextureUsage usageOf(const SlotDeclaration& slot) {
    switch (slot.use) {
        case SlotUse::Color:
        case SlotUse::Depth:
            return rhi::TextureUsage::RenderAttachment;
        case SlotUse::Sampled:
            return rhi::TextureUsage::TextureBinding;
        case SlotUse::Storage:
            return rhi::TextureUsage::StorageBinding;
        case SlotUse::Copy:
            return slot.access == SlotAccess::Read ? rhi::TextureUsage::CopySrc : rhi::TextureUsage::CopyDst;
        case SlotUse::Uniform:
            break;
    }
    return rhi::TextureUsage::None;
}

std::string text(const rhi::Extent3D& extent) {
    return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

class Describer {
public:
    explicit Describer(Linker& linker) : linker_(linker) {}

    void run() {
        for (const std::uint32_t index : linker_.order) {
            for (const LinkedSlot& slot : linker_.passes[index].slots) {
                if (slot.in != none) use(linker_.resources[linker_.versions[slot.in].resource], slot);
            }
        }
        for (const auto& [name, version] : linker_.exportVersions) {
            PlanResource& image = linker_.resources[linker_.versions[version].resource].plan;
            image.usage = image.usage | rhi::TextureUsage::TextureBinding;
            if (image.samples == 1) image.usage = image.usage | rhi::TextureUsage::CopySrc;
        }
        for (LinkedResource& resource : linker_.resources) chooseFormat(resource);
        for (const std::uint32_t index : linker_.order) passFits(linker_.passes[index]);
    }

private:
    void use(LinkedResource& resource, const LinkedSlot& slot) {
        if (resource.index == none) {
            resource.index = static_cast<std::uint32_t>(linker_.plan.resources.size());
            linker_.plan.resources.emplace_back();  // filled in when everything is known
            if (resource.attachment) attachment(resource);
            if (resource.import) import(resource);
            if (!resource.attachment && !resource.import) constant(resource.plan);
        }
        resource.plan.usage = resource.plan.usage | usageOf(*slot.says);
    }

    static void constant(PlanResource& image) {
        image.extent = {1, 1, 1};
        const std::string name = image.name.substr(image.name.find('.') + 1);
        image.cube = name == "blackCube";
        image.layers = image.cube ? 6 : 1;
        image.format = isDepthConstant(name) ? rhi::TextureFormat::Depth32Float : rhi::TextureFormat::RGBA8Unorm;
    }

    void import(LinkedResource& resource) {
        const ImportDeclaration& says = *resource.import;
        const auto found = linker_.host.imports.find(says.name);
        if (found == linker_.host.imports.end() || resource.plan.isBuffer) return;
        const ImportDescription& lent = found->second;
        PlanResource& image = resource.plan;
        image.format = lent.format;
        image.extent = lent.extent;
        image.samples = lent.samples;
        image.layers = lent.extent.depthOrArrayLayers;
        if (!says.formats.empty() &&
            std::find(says.formats.begin(), says.formats.end(), lent.format) == says.formats.end()) {
            std::string accepted;
            for (const rhi::TextureFormat format : says.formats)
                accepted += (accepted.empty() ? "" : ", ") + std::string(rhi::name(format));
            linker_.reporter.error(
                says.place, "H002",
                "'" + image.name + "' is " + std::string(rhi::name(lent.format)) + "; the tree accepts " + accepted);
        }
        if (!says.samples.empty() &&
            std::find(says.samples.begin(), says.samples.end(), lent.samples) == says.samples.end()) {
            linker_.reporter.error(says.place, "H002",
                                   "'" + image.name + "' has " + std::to_string(lent.samples) +
                                       " samples, which the tree does not accept");
        }
    }

    void attachment(LinkedResource& resource) {
        const AttachmentDeclaration& says = *resource.attachment;
        PlanResource& image = resource.plan;
        image.format = says.formats.front();
        image.samples = static_cast<std::uint32_t>(linker_.number(says.samples));
        image.layers = says.layersView.empty() ? says.layers : std::max(1U, linker_.plan.viewCounts[says.layersView]);
        const auto [width, height] = size(says.size);
        if (width < 1 || height < 1 || width > largestSide || height > largestSide) {
            if (!sizeFailed_) {
                linker_.reporter.error(says.size.place, "D002",
                                       "'" + image.name + "' would be " + std::to_string(width) + " x " +
                                           std::to_string(height) + "; a side is 1.." + std::to_string(largestSide));
            }
            sizeFailed_ = false;
            return;
        }
        image.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), image.layers};
        if (image.layers > 256) {
            linker_.reporter.error(
                says.layersPlace, "D002",
                "'" + image.name + "' would have " + std::to_string(image.layers) + " layers; at most 256");
        }
    }

    using Sides = std::pair<std::uint64_t, std::uint64_t>;
    static Sides scaled(std::uint32_t width, std::uint32_t height, double scale) {
        const auto up = [scale](std::uint32_t side) { return static_cast<std::uint64_t>(std::ceil(side * scale)); };
        return {up(width), up(height)};
    }

    // Circles were refused by check.cpp, so this ends.
    Sides size(const SizeDeclaration& says) {
        using Kind = SizeDeclaration::Kind;
        const auto whole = [](double number) { return static_cast<std::uint64_t>(std::max(0.0, number)); };
        switch (says.kind) {
            case Kind::Frame:
                return scaled(linker_.host.extent.width, linker_.host.extent.height, says.scale);
            case Kind::Square:
                return {whole(linker_.number(says.width)), whole(linker_.number(says.width))};
            case Kind::Fixed:
                return {whole(linker_.number(says.width)), whole(linker_.number(says.height))};
            case Kind::Like:
                break;
        }
        if (says.like.rfind("host.", 0) == 0) {
            const auto lent = linker_.host.imports.find(says.like.substr(5));
            if (lent == linker_.host.imports.end() || !lent->second.present) {
                linker_.reporter.error(says.place, "P031",
                                       "a size follows '" + says.like + "', which the host does not lend");
                sizeFailed_ = true;
                return {0, 0};
            }
            return scaled(lent->second.extent.width, lent->second.extent.height, says.scale);
        }
        const AttachmentDeclaration* other = linker_.tree.attachment(says.like.substr(4));
        if (!other) return {0, 0};
        const auto [width, height] = size(other->size);
        if (std::max(width, height) > largestSide) return {width, height};
        return scaled(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), says.scale);
    }

    void chooseFormat(LinkedResource& resource) {
        if (!resource.attachment || resource.index == none || !linker_.host.supports) return;
        for (const rhi::TextureFormat format : resource.attachment->formats) {
            resource.plan.format = format;
            if (linker_.host.supports(format, resource.plan.usage, resource.plan.samples)) return;
        }
        linker_.reporter.error(
            resource.attachment->formatPlace, "D001",
            "the device can make 'att." + resource.attachment->name + "' in none of its formats with " +
                std::to_string(resource.plan.samples) + " samples",
            resource.attachment->formats.size() > 1 ? "lower the samples" : "name \"formatFallbacks\"");
    }

    void passFits(const LinkedPass& pass) {
        const LinkedSlot* first = nullptr;
        std::uint32_t views = pass.says->forEachLayer ? linker_.plan.viewCounts[pass.says->view] : 1;
        const LinkedSlot* copies[2] = {};
        for (const LinkedSlot& slot : pass.slots) {
            if (slot.in == none) continue;
            slotFits(pass, slot, views);
            if (slot.says->use == SlotUse::Copy) copies[slot.says->access == SlotAccess::Read ? 0 : 1] = &slot;
            if (!isTarget(*slot.says)) continue;
            if (first) targetsFit(pass, *first, slot);
            if (!first) first = &slot;
        }
        if (copies[0] && copies[1]) copyFits(pass, *copies[0], *copies[1]);
        conflicts(pass);
    }

    const LinkedResource& resourceOf(const LinkedSlot& slot) const {
        return linker_.resources[linker_.versions[slot.in].resource];
    }
    Place placeOf(const LinkedSlot& slot) const { return slot.source ? slot.source->place : slot.says->place; }

    void slotFits(const LinkedPass& pass, const LinkedSlot& slot, std::uint32_t views) {
        const PlanResource& image = resourceOf(slot).plan;
        if (image.isBuffer) return;
        const std::string title = "'" + pass.says->name + "." + slot.says->name + "'";
        const bool depth = rhi::isDepth(image.format);
        const bool wrong = (slot.says->use == SlotUse::Color && depth) ||
                           (slot.says->use == SlotUse::Depth && !depth) ||
                           (slot.says->use == SlotUse::Storage && depth);
        if (wrong) {
            linker_.reporter.error(placeOf(slot), "P037",
                                   title + " is a " + word(slot.says->use) + " slot, '" + image.name + "' is " +
                                       std::string(rhi::name(image.format)));
        }
        if (slot.says->use == SlotUse::Storage && image.samples > 1) {
            linker_.reporter.error(
                placeOf(slot), "P042",
                title + " is storage, '" + image.name + "' has " + std::to_string(image.samples) + " samples");
        }
        if (!isTarget(*slot.says)) return;
        if (pass.says->forEachLayer ? image.layers < views : image.layers > 1) {
            linker_.reporter.error(placeOf(slot), "P039",
                                   title + " draws into " + std::to_string(views) + " layer(s), '" + image.name +
                                       "' has " + std::to_string(image.layers),
                                   pass.says->forEachLayer
                                       ? "give it \"layers\": {\"view\": \"" + pass.says->view + "\"}"
                                       : "add \"forEachView\": \"layer\"");
        }
    }

    void targetsFit(const LinkedPass& pass, const LinkedSlot& a, const LinkedSlot& b) {
        const PlanResource& left = resourceOf(a).plan;
        const PlanResource& right = resourceOf(b).plan;
        if (left.samples != right.samples) {
            linker_.reporter.error(placeOf(b), "P038",
                                   "targets of '" + pass.says->name + "' differ in samples: '" + left.name + "' (" +
                                       std::to_string(left.samples) + "), '" + right.name + "' (" +
                                       std::to_string(right.samples) + ")",
                                   "give both the same \"samples\"");
        }
        if (left.extent.width != right.extent.width || left.extent.height != right.extent.height) {
            linker_.reporter.error(placeOf(b), "P039",
                                   "targets of '" + pass.says->name + "' differ in size: '" + left.name + "' (" +
                                       text(left.extent) + "), '" + right.name + "' (" + text(right.extent) + ")",
                                   "give both the same \"size\"");
        }
    }

    void copyFits(const LinkedPass& pass, const LinkedSlot& from, const LinkedSlot& to) {
        const PlanResource& a = resourceOf(from).plan;
        const PlanResource& b = resourceOf(to).plan;
        if (a.format == b.format && a.extent == b.extent && a.samples == b.samples) return;
        linker_.reporter.error(placeOf(to), "P039",
                               "copy pass '" + pass.says->name + "' needs equal images: '" + a.name + "' and '" +
                                   b.name + "' differ in format, size or samples");
    }

    // One image twice in a pass is fine while nobody writes it.
    void conflicts(const LinkedPass& pass) {
        for (std::size_t i = 0; i < pass.slots.size(); ++i) {
            for (std::size_t j = i + 1; j < pass.slots.size(); ++j) {
                const LinkedSlot& a = pass.slots[i];
                const LinkedSlot& b = pass.slots[j];
                if (a.in == none || b.in == none || linker_.versions[a.in].resource != linker_.versions[b.in].resource)
                    continue;
                if (a.says->access == SlotAccess::Read && b.says->access == SlotAccess::Read) continue;
                linker_.reporter.error(placeOf(b), "P042",
                                       "slots '" + a.says->name + "' and '" + b.says->name + "' of '" +
                                           pass.says->name + "' use '" + resourceOf(a).plan.name +
                                           "' at once, and one writes it",
                                       "write to another attachment");
            }
        }
    }

    Linker& linker_;
    bool sizeFailed_ = false;
};

}  // namespace

void Linker::describeImages() {
    Describer(*this).run();
}

}  // namespace pelage::passes
