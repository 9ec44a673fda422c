// SPDX-License-Identifier: MIT
// Format, size, samples, layers and usage of every image that a live pass touches, and whether they fit together.
#include "link.hpp"
#include "plan_text.hpp"

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
        image.is3D = name == "transparent3D";
        image.layers = image.cube ? 6 : 1;
        image.format = isDepthConstant(name) ? rhi::TextureFormat::Depth32Float : rhi::TextureFormat::RGBA8Unorm;
    }

    void import(LinkedResource& resource) {
        const ImportDeclaration& says = *resource.import;
        const auto found = linker_.host.imports.find(says.name);
        if (found == linker_.host.imports.end() || resource.plan.isBuffer) return;
        const LentImport& lent = found->second;
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
        const Sides sides = size(says.size);
        image.is3D = sides.depth > 0;
        const std::uint32_t most = image.is3D ? linker_.host.maxSide3D : linker_.host.maxSide;
        if (sides.width < 1 || sides.height < 1 || std::max({sides.width, sides.height, sides.depth}) > most) {
            if (!sizeFailed_) {
                linker_.reporter.error(
                    says.size.place, "D002",
                    "'" + image.name + "' would be " + sidesText(sides) + "; a side is 1.." + std::to_string(most),
                    settingHint(says.size.width));
            }
            sizeFailed_ = false;
            image.mipLevels = unknownLevels;
            return;
        }
        image.extent = {static_cast<std::uint32_t>(sides.width), static_cast<std::uint32_t>(sides.height),
                        image.is3D ? static_cast<std::uint32_t>(sides.depth) : image.layers};
        if (image.is3D && image.layers > 1)
            linker_.reporter.error(says.layersPlace, "P062",
                                   "'" + image.name + "' is 3D, as what its size follows: it has no layers",
                                   "remove it");
        levels(image, says);
        if (image.layers > linker_.host.maxLayers) {
            linker_.reporter.error(says.layersPlace, "D002",
                                   "'" + image.name + "' would have " + std::to_string(image.layers) +
                                       " layers; at most " + std::to_string(linker_.host.maxLayers));
        }
    }

    // Of an image that was refused: any level a slot names, so that one fault is not told twice.
    static constexpr std::uint32_t unknownLevels = 16;

    void levels(PlanResource& image, const AttachmentDeclaration& says) {
        const std::uint32_t most = mipLevelsOf(image);
        const double wanted = says.allMipLevels ? most : linker_.number(says.mipLevels);
        if (wanted >= 1 && wanted <= most) {
            image.mipLevels = static_cast<std::uint32_t>(wanted);
        } else {
            linker_.reporter.error(says.mipLevels.place, "P061",
                                   "'" + image.name + "' of " + shapeText(image) + " cannot have " +
                                       std::to_string(static_cast<long long>(wanted)) + " mip levels: it has 1.." +
                                       std::to_string(most),
                                   R"(write "full" for all of them)");
            image.mipLevels = unknownLevels;
            return;
        }
        if (image.mipLevels > 1 && image.samples > 1) {
            linker_.reporter.error(says.mipLevels.place, "P061",
                                   "'" + image.name + "' would have several mip levels and " +
                                       std::to_string(image.samples) + " samples; an image has several of one only");
        }
    }
    static std::uint32_t mipLevelsOf(const PlanResource& image) {
        std::uint32_t side = std::max(image.extent.width, image.extent.height), levels = 1;
        if (image.is3D) side = std::max(side, image.extent.depthOrArrayLayers);
        for (; side > 1; side /= 2) ++levels;
        return levels;
    }

    static std::string settingHint(const NumberOrSetting& value) {
        return value.setting.empty() ? std::string{} : "lower or raise the setting '" + value.setting + "'";
    }

    void buffer(LinkedResource& resource) {
        const BytesDeclaration& says = resource.attachment->bytes;
        double bytes = linker_.number(says.count) * says.times;
        if (says.perPixel) {
            const Sides sides = size(says.pixels);
            bytes *= static_cast<double>(sides.width) * static_cast<double>(sides.height) *
                     static_cast<double>(std::max<std::uint64_t>(1, sides.depth));
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

    struct Sides {
        std::uint64_t width = 0, height = 0, depth = 0;  // depth 0: not 3D
    };
    static std::string sidesText(const Sides& sides) {
        return std::to_string(sides.width) + " x " + std::to_string(sides.height) +
               (sides.depth > 0 ? " x " + std::to_string(sides.depth) : "");
    }
    static Sides scaled(const Sides& sides, double scale) {
        const auto up = [scale](std::uint64_t side) {
            return static_cast<std::uint64_t>(std::ceil(static_cast<double>(side) * scale));
        };
        return {up(sides.width), up(sides.height), up(sides.depth)};
    }

    Sides size(const SizeDeclaration& says) {
        Sides sides = flatSize(says);
        if (says.depth) sides.depth = whole(linker_.number(*says.depth));
        // No texel in depth is a size that fails, not an image that is not 3D.
        if (says.depth && sides.depth == 0) sides.width = 0;
        return sides;
    }
    static std::uint64_t whole(double number) { return static_cast<std::uint64_t>(std::max(0.0, number)); }

    // Circles were refused by check.cpp, so this ends.
    Sides flatSize(const SizeDeclaration& says) {
        using Kind = SizeDeclaration::Kind;
        switch (says.kind) {
            case Kind::Frame:
                return scaled({linker_.host.extent.width, linker_.host.extent.height}, says.scale);
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
                return {};
            }
            return scaled({lent->second.extent.width, lent->second.extent.height}, says.scale);
        }
        const Sides sides = size(linker_.tree.attachments[says.likeIndex].size);
        if (std::max({sides.width, sides.height, sides.depth}) > linker_.host.maxSide) return sides;
        return scaled(sides, says.scale);
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
    rhi::Extent3D extentOf(const LinkedSlot& slot) const {
        const PlanResource& image = resourceOf(slot).plan;
        return levelExtent(image.extent, image.is3D, slot.says->level == none ? 0 : slot.says->level);
    }
    std::uint32_t levelsOf(const LinkedSlot& slot) const {
        return slot.says->level == none ? resourceOf(slot).plan.mipLevels : 1;
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
        if (image.isBuffer && slot.says->level != none)
            linker_.reporter.error(slot.says->levelPlace, "P061",
                                   title() + " is a mip level, but '" + image.name + "' is a buffer", "remove it");
        if (image.isBuffer) return;
        if (slot.says->level != none && slot.says->level >= image.mipLevels) {
            linker_.reporter.error(slot.says->levelPlace, "P061",
                                   title() + " is mip level " + std::to_string(slot.says->level) + ", '" + image.name +
                                       "' of " + shapeText(image) + " has " + std::to_string(image.mipLevels),
                                   "levels count from 0; give the attachment more \"mipLevels\"");
            return;
        }
        if (image.is3D && isTarget(*slot.says)) {
            linker_.reporter.error(placeOf(slot), "P062",
                                   title() + " is a " + std::string(word(use)) + " slot; nothing is drawn into '" +
                                       image.name + "', which is 3D",
                                   "write it as \"storage\" in a compute pass");
        }
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
        const rhi::Extent3D one = extentOf(a), other = extentOf(b);
        if (one.width != other.width || one.height != other.height) {
            linker_.reporter.error(placeOf(b), "P039",
                                   "targets of '" + pass.says->name + "' differ in size: '" + left.name + "' (" +
                                       text(one) + "), '" + right.name + "' (" + text(other) + ")",
                                   "give both the same \"size\"");
        }
    }

    void copyFits(const LinkedPass& pass, const LinkedSlot& from, const LinkedSlot& to) {
        const PlanResource& a = resourceOf(from).plan;
        const PlanResource& b = resourceOf(to).plan;
        const bool lentBuffer = a.isBuffer && (a.bytes == 0 || b.bytes == 0);  // its size is known when it is lent
        if (a.isBuffer == b.isBuffer && (a.bytes == b.bytes || lentBuffer || !a.isBuffer) && a.format == b.format &&
            extentOf(from) == extentOf(to) && levelsOf(from) == levelsOf(to) && a.is3D == b.is3D &&
            a.samples == b.samples)
            return;
        linker_.reporter.error(placeOf(to), "P039",
                               "copy pass '" + pass.says->name + "' needs equal images or buffers: '" + a.name +
                                   "' and '" + b.name + "' differ in kind, format, size, levels or samples");
    }

    // One image twice in a pass is fine while the pass only reads it.
    void conflicts(const LinkedPass& pass) {
        const std::span<const LinkedSlot> slots = linker_.slotsOf(pass);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            for (std::size_t j = i + 1; j < slots.size(); ++j) {
                const LinkedSlot& a = slots[i];
                const LinkedSlot& b = slots[j];
                if (a.in == none || b.in == none || linker_.versions[a.in].resource != linker_.versions[b.in].resource)
                    continue;
                if (a.says->access == SlotAccess::Read && b.says->access == SlotAccess::Read) continue;
                // So a pyramid is built: one level from the one below it.
                const std::uint32_t levelA = levelOf(*a.says), levelB = levelOf(*b.says);
                if (levelA != none && levelB != none && levelA != levelB) continue;
                linker_.reporter.error(placeOf(b), "P042",
                                       "slots '" + a.says->name + "' and '" + b.says->name + "' of '" +
                                           pass.says->name + "' use '" + resourceOf(a).plan.name +
                                           "' at once, and one writes it",
                                       resourceOf(a).plan.mipLevels > 1 ? "give each a \"level\" of its own"
                                                                        : "write to another attachment");
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
