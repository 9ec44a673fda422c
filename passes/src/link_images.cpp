// SPDX-License-Identifier: MIT
// Format, size, samples, layers and usage of every image that a live pass touches, and whether they fit together.
#include "link.hpp"

#include <cmath>

namespace pelage::passes {
namespace {

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
        case SlotUse::Vertex:
        case SlotUse::Indirect:
            break;
    }
    return rhi::TextureUsage::None;
}

rhi::BufferUsage bufferUsageOf(const SlotDeclaration& slot) {
    const rhi::BufferUsage cleared = slot.clearIsZero ? rhi::BufferUsage::CopyDst : rhi::BufferUsage::None;
    switch (slot.use) {
        case SlotUse::Storage:
            return cleared | rhi::BufferUsage::Storage;
        case SlotUse::Uniform:
            return rhi::BufferUsage::Uniform;
        case SlotUse::Copy:
            return slot.access == SlotAccess::Read ? rhi::BufferUsage::CopySrc : rhi::BufferUsage::CopyDst;
        case SlotUse::Vertex:
            return rhi::BufferUsage::Vertex;
        case SlotUse::Indirect:
            return rhi::BufferUsage::Indirect;
        default:
            return rhi::BufferUsage::None;
    }
}

std::string text(const rhi::Extent3D& extent) {
    return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

class Describer {
public:
    explicit Describer(Linker& linker) : linker_(linker) {}

    void run() {
        for (const std::uint32_t index : linker_.order) {
            for (const LinkedSlot& slot : linker_.slotsOf(linker_.passes[index])) {
                ++linker_.visits;
                if (slot.in != none) use(linker_.resourceOf(slot), slot);
            }
        }
        for (const std::uint32_t version : linker_.exportVersions) {
            if (version == none) continue;
            PlanResource& image = linker_.resources[linker_.versions[version].resource].plan;
            image.usage = image.usage | rhi::TextureUsage::TextureBinding;
            image.bufferUsage = image.bufferUsage | rhi::BufferUsage::CopySrc;
            if (image.samples == 1) image.usage = image.usage | rhi::TextureUsage::CopySrc;
        }
        joinHistories();
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
        resource.plan.bufferUsage = resource.plan.bufferUsage | bufferUsageOf(*slot.says);
    }

    // Both images of a pair take turns, so what one is used for the other is too. The first frame clears what it reads.
    void joinHistories() {
        for (LinkedResource& history : linker_.resources) {
            if (history.plan.kind != PlanResource::Kind::History || history.index == none) continue;
            PlanResource& last = history.plan;
            const auto attachment = static_cast<std::size_t>(history.attachment - linker_.tree.attachments.data());
            const std::uint32_t at = linker_.ofAttachment[attachment];
            LinkedResource* written = at == none ? nullptr : &linker_.resources[at];
            if (written && written->index == none) written = nullptr;
            if (written) {
                last.partner = written->index;
                written->plan.partner = history.index;
                last.usage = last.usage | written->plan.usage;
                last.bufferUsage = last.bufferUsage | written->plan.bufferUsage;
            }
            last.usage = last.usage | rhi::TextureUsage::RenderAttachment;
            last.bufferUsage = last.bufferUsage | rhi::BufferUsage::CopyDst;
            const SlotDeclaration* begins = written ? beginner(*written) : nullptr;
            if (begins && begins->hasClear && !begins->clearIsDepth) last.historyClear = begins->clear;
            const float far = linker_.host.depth == DepthConvention::Reversed ? 0.0F : 1.0F;
            if (!last.isBuffer && rhi::isDepth(last.format))
                last.historyClear.r = begins && begins->clearIsDepth ? depthOf(*begins, linker_.host.depth) : far;
            if (!written) continue;
            written->plan.usage = last.usage;
            written->plan.bufferUsage = last.bufferUsage;
        }
    }

    const SlotDeclaration* beginner(const LinkedResource& resource) const {
        const Version& version = linker_.versions[resource.base];
        if (version.modifier == none) return nullptr;
        return linker_.slots[linker_.passes[version.modifier].firstSlot + version.modifierSlot].says;
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
                says.place, "P081",
                "'" + image.name + "' is " + std::string(rhi::name(lent.format)) + "; the tree accepts " + accepted);
        }
        if (!says.samples.empty() &&
            std::find(says.samples.begin(), says.samples.end(), lent.samples) == says.samples.end()) {
            linker_.reporter.error(says.place, "P081",
                                   "'" + image.name + "' has " + std::to_string(lent.samples) +
                                       " samples, which the tree does not accept");
        }
    }

    void attachment(LinkedResource& resource) {
        const AttachmentDeclaration& says = *resource.attachment;
        PlanResource& image = resource.plan;
        if (says.isBuffer) return buffer(resource);
        image.format = says.formats.front();
        image.samples = static_cast<std::uint32_t>(linker_.number(says.samples));
        image.layers = says.layersView.empty() ? says.layers : std::max(1U, linker_.viewCounts[says.viewIndex]);
        const auto [width, height] = size(says.size);
        if (width < 1 || height < 1 || width > linker_.host.maxSide || height > linker_.host.maxSide) {
            if (!sizeFailed_) {
                linker_.reporter.error(says.size.place, "D002",
                                       "'" + image.name + "' would be " + std::to_string(width) + " x " +
                                           std::to_string(height) + "; a side is 1.." +
                                           std::to_string(linker_.host.maxSide),
                                       settingHint(says.size.width));
            }
            sizeFailed_ = false;
            return;
        }
        image.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), image.layers};
        if (image.layers > linker_.host.maxLayers) {
            linker_.reporter.error(says.layersPlace, "D002",
                                   "'" + image.name + "' would have " + std::to_string(image.layers) +
                                       " layers; at most " + std::to_string(linker_.host.maxLayers));
        }
    }

    static std::string settingHint(const NumberOrSetting& value) {
        return value.setting.empty() ? std::string{} : "lower or raise the setting '" + value.setting + "'";
    }

    void buffer(LinkedResource& resource) {
        const BytesDeclaration& says = resource.attachment->bytes;
        double bytes = linker_.number(says.count) * says.times;
        if (says.perPixel) {
            const auto [width, height] = size(says.pixels);
            bytes *= static_cast<double>(width) * static_cast<double>(height);
        }
        bytes = std::ceil(bytes / 16) * 16;
        const std::uint64_t most = std::min<std::uint64_t>(1ULL << 32, linker_.host.maxBytes);
        if (bytes < 1 || bytes > static_cast<double>(most)) {
            if (!sizeFailed_) {
                linker_.reporter.error(says.place, "D002",
                                       "'" + resource.plan.name + "' would have " +
                                           std::to_string(static_cast<long long>(bytes)) + " bytes; a buffer has 1.." +
                                           std::to_string(most),
                                       settingHint(says.count));
            }
            sizeFailed_ = false;
            return;
        }
        resource.plan.bytes = static_cast<std::uint64_t>(bytes);
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
            const auto lent = linker_.host.imports.find(linker_.tree.imports[says.likeIndex].name);
            if (lent == linker_.host.imports.end() || !lent->second.present) {
                linker_.reporter.error(says.place, "P031",
                                       "a size follows '" + says.like + "', which the host does not lend");
                sizeFailed_ = true;
                return {0, 0};
            }
            return scaled(lent->second.extent.width, lent->second.extent.height, says.scale);
        }
        const auto [width, height] = size(linker_.tree.attachments[says.likeIndex].size);
        if (std::max(width, height) > linker_.host.maxSide) return {width, height};
        return scaled(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), says.scale);
    }

    void chooseFormat(LinkedResource& resource) {
        if (!resource.attachment || resource.index == none || !linker_.host.supports || resource.plan.isBuffer) return;
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
        const std::uint32_t views = pass.says->forEachLayer ? linker_.viewCounts[pass.says->viewIndex] : 1;
        const LinkedSlot* copies[2] = {};
        for (const LinkedSlot& slot : linker_.slotsOf(pass)) {
            ++linker_.visits;
            if (slot.in == none) continue;
            slotFits(pass, slot, views);
            if (slot.says->use == SlotUse::Copy) copies[slot.says->access == SlotAccess::Read ? 0 : 1] = &slot;
            if (!isTarget(*slot.says)) continue;
            if (first) targetsFit(pass, *first, slot);
            if (!first) first = &slot;
        }
        // What a class copies is its own affair.
        if (copies[0] && copies[1] && pass.says->passClass.empty()) copyFits(pass, *copies[0], *copies[1]);
        conflicts(pass);
    }

    const LinkedResource& resourceOf(const LinkedSlot& slot) const {
        return linker_.resources[linker_.versions[slot.in].resource];
    }
    Place placeOf(const LinkedSlot& slot) const { return slot.source ? slot.source->place : slot.says->place; }

    void slotFits(const LinkedPass& pass, const LinkedSlot& slot, std::uint32_t views) {
        const PlanResource& image = resourceOf(slot).plan;
        const SlotUse use = slot.says->use;
        const auto title = [&] { return "'" + pass.says->name + "." + slot.says->name + "'"; };
        const bool either = use == SlotUse::Storage || use == SlotUse::Copy;
        if (!either && image.isBuffer != isBufferUse(use)) {
            linker_.reporter.error(placeOf(slot), "P037",
                                   "'" + image.name + "' is " + (image.isBuffer ? "a buffer" : "an image") + "; " +
                                       title() + " is " + std::string(word(use)));
            return;
        }
        if (image.isBuffer) return;
        const bool depth = rhi::isDepth(image.format);
        const bool wrong =
            (use == SlotUse::Color && depth) || (use == SlotUse::Depth && !depth) || (use == SlotUse::Storage && depth);
        if (wrong) {
            linker_.reporter.error(placeOf(slot), "P037",
                                   title() + " is a " + std::string(word(use)) + " slot, '" + image.name + "' is " +
                                       std::string(rhi::name(image.format)));
        }
        if (use == SlotUse::Storage && image.samples > 1) {
            linker_.reporter.error(
                placeOf(slot), "P042",
                title() + " is storage, '" + image.name + "' has " + std::to_string(image.samples) + " samples");
        }
        if (!isTarget(*slot.says)) return;
        if (pass.says->forEachLayer ? image.layers < views : image.layers > 1) {
            linker_.reporter.error(placeOf(slot), "P039",
                                   title() + " draws into " + std::to_string(views) + " layer(s), '" + image.name +
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
        const bool lentBuffer = a.isBuffer && (a.bytes == 0 || b.bytes == 0);  // its size is known when it is lent
        if (a.isBuffer == b.isBuffer && (a.bytes == b.bytes || lentBuffer || !a.isBuffer) && a.format == b.format &&
            a.extent == b.extent && a.samples == b.samples)
            return;
        linker_.reporter.error(placeOf(to), "P039",
                               "copy pass '" + pass.says->name + "' needs equal images or buffers: '" + a.name +
                                   "' and '" + b.name + "' differ in kind, format, size or samples");
    }

    // One image twice in a pass is fine while nobody writes it.
    void conflicts(const LinkedPass& pass) {
        const std::span<const LinkedSlot> slots = linker_.slotsOf(pass);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            for (std::size_t j = i + 1; j < slots.size(); ++j) {
                const LinkedSlot& a = slots[i];
                const LinkedSlot& b = slots[j];
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
