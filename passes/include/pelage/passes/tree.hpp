// SPDX-License-Identifier: MIT
// A pass tree: the frame as data. Read from *.pass.json, checked against its schema, then compiled for given settings,
// imports and extents into a Plan: order from data, what is culled, load and store, lifetimes. No device is needed
// here.
#pragma once

#include <pelage/json/diagnostic.hpp>
#include <pelage/rhi/types.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::passes {

/// Whether 1 or 0 is the far plane; said once by the host, never in a file.
enum class DepthConvention : std::uint8_t { Reversed, Conventional };

enum class PassKind : std::uint8_t { Raster, Fullscreen, Compute, Copy };
enum class SlotAccess : std::uint8_t { Read, Write, ReadWrite };
enum class SlotUse : std::uint8_t { Color, Depth, Sampled, Storage, Uniform, Copy };

/// The value of a setting: bool, uint or a word of an enum.
struct SettingValue {
    enum class Type : std::uint8_t { Bool, Uint, Enum } type = Type::Bool;
    std::uint32_t number = 0;  // bool: 0 or 1; enum: index of the word
    std::string word = {};
    bool operator==(const SettingValue&) const = default;
};

struct SettingInfo {
    std::string name = {}, description = {};
    SettingValue::Type type = SettingValue::Type::Bool;
    std::uint32_t min = 0, max = 0, multipleOf = 1;
    std::vector<std::string> words = {};
    SettingValue defaultValue = {};
};

/// What the host lends: an image (external, with its own size and format) or a buffer.
struct ImportDescription {
    bool present = false;
    rhi::TextureFormat format = rhi::TextureFormat::Undefined;
    rhi::Extent3D extent = {};
    std::uint32_t samples = 1;
    bool operator==(const ImportDescription&) const = default;
};

struct HostDescription {
    rhi::Extent3D extent = {};  // of the frame; "frame" in size references
    DepthConvention depth = DepthConvention::Reversed;
    std::map<std::string, SettingValue> settings = {};      // those that differ from the defaults
    std::map<std::string, ImportDescription> imports = {};  // by name
    /// Whether the device can make such an image; decides between "format" and "formatFallbacks". Empty: it can.
    /// Graph::build fills it in.
    std::function<bool(rhi::TextureFormat, rhi::TextureUsage, std::uint32_t samples)> supports = {};
};

struct Plan;

class PassTree {
public:
    static Checked<std::shared_ptr<const PassTree>> parse(std::string_view text, const std::string& file);
    static Checked<std::shared_ptr<const PassTree>> load(const std::string& path);

    const std::string& name() const;
    const std::string& file() const;
    const std::vector<SettingInfo>& settings() const;
    std::vector<std::string> drawLists() const;
    std::vector<std::string> exports() const;
    const Diagnostics& warnings() const;

    /// Links and schedules. All faults at once; warnings come with the plan.
    Checked<Plan> compile(const HostDescription& host) const;

    struct Description;  // src/description.hpp: what the file says, typed
    const Description& description() const { return *description_; }

private:
    std::shared_ptr<const Description> description_;
};

/// An image or buffer that the plan creates (transient) or that the host lends.
struct PlanResource {
    std::string name = {};  // "att.HairDepth", "host.SceneColor", "const.depthFarArray"
    enum class Kind : std::uint8_t { Transient, Import, Constant } kind = Kind::Transient;
    rhi::TextureFormat format = rhi::TextureFormat::Undefined;
    rhi::Extent3D extent = {};
    std::uint32_t samples = 1, layers = 1;
    bool cube = false, isBuffer = false;
    /// Transient images with the same number share one texture: their lifetimes do not overlap. ~0 for the others.
    std::uint32_t allocation = ~0U;
    rhi::TextureUsage usage = rhi::TextureUsage::None;  // gathered from the slots
    std::uint64_t bytes = 0;
    std::uint32_t firstPass = 0, lastPass = 0;  // indices into Plan::passes
};

struct PlanSlot {
    std::string name = {}, bind = {};
    SlotAccess access = SlotAccess::Read;
    SlotUse use = SlotUse::Color;
    std::uint32_t resource = ~0U;  // ~0: optional and not connected
    rhi::LoadOp load = rhi::LoadOp::Load;
    rhi::StoreOp store = rhi::StoreOp::Store;
    rhi::Color clear = {};  // colour
    float clearDepth = 0;   // for the host's depth convention
    bool blendPremultiplied = false;
    bool depthTestAlways = false;  // fullscreen passes that write depth
};

struct PlanPass {
    std::string name = {}, drawList = {}, view = {}, shader = {};
    PassKind kind = PassKind::Raster;
    bool forEachLayer = false;
    enum class Sort : std::uint8_t { None, FrontToBack, BackToFront } sort = Sort::None;
    std::vector<PlanSlot> slots = {};
    std::map<std::string, double> constants = {};  // specialization constants of a fullscreen or compute shader
    std::uint32_t dispatch[3] = {1, 1, 1};         // Compute: workgroups
};

struct Plan {
    std::vector<PlanPass> passes = {};  // in execution order
    std::vector<PlanResource> resources = {};
    std::map<std::string, std::uint32_t> exports = {};  // export name -> resource index
    std::vector<std::string> culled = {};  // "ToneMap: no export needs its result", "HairShadow: switched off …"
    std::map<std::string, std::uint32_t> viewCounts = {};
    DepthConvention depth = DepthConvention::Reversed;
    std::uint32_t allocations = 0;     // textures behind the transient images
    std::uint64_t allocatedBytes = 0;  // of them; at most the sum over the transient resources
    Diagnostics warnings = {};
    /// Graphviz text of the compiled graph.
    std::string dot() const;
};

/// The text of a shipped tree ("hair_frame.pass.json") or of its schema ("passtree.schema.json"); empty when unknown.
std::string_view shippedText(std::string_view file);

}  // namespace pelage::passes
