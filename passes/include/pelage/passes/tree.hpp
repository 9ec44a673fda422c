// SPDX-License-Identifier: MIT
// A pass tree: the frame as data. Read from *.pass.json, checked against its schema, then compiled for given settings,
// imports and extents into a Plan: order from data, what is culled, load and store, lifetimes. No device is needed
// here.
#pragma once

#include <pelage/base/diagnostic.hpp>
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
enum class SlotUse : std::uint8_t { Color, Depth, Sampled, Storage, Uniform, Copy, Vertex, Indirect };

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

/// What the host lends to an import: an image with its own size and format, or a buffer.
struct LentImport {
    bool present = false;
    rhi::TextureFormat format = rhi::TextureFormat::Undefined;
    rhi::Extent3D extent = {};
    std::uint32_t samples = 1;
    bool operator==(const LentImport&) const = default;
};

/// What a tree wants a host to lend to an import.
struct WantedImport {
    std::string name = {};
    bool buffer = false, cube = false, optional = false;
    std::vector<rhi::TextureFormat> formats = {};  // that the tree accepts; empty: any
    std::vector<std::uint32_t> samples = {};       // the same
};

/// A parameter that a pass class takes from the file: `"parameters": {"radius": 2.5}`.
struct ParameterInfo {
    enum class Type : std::uint8_t { Number, Bool, Word };
    std::string name = {}, description = {};
    Type type = Type::Number;
    double min = 0, max = 1;              // Number; inclusive
    std::vector<std::string> words = {};  // Word: those it can be
    bool required = false;                // otherwise the file may leave it out and the default counts
    double defaultNumber = 0;             // Number; Bool: 0 or 1; Word: the index of the word
};

/// What the linker must know of a pass class that the host registered. See <pelage/passes/pass_class.hpp>.
struct PassClassInfo {
    std::string name = {};  // as a file says it: "class": "Outline"
    /// What it records: one render pass into its color and depth slots, one compute pass, or copies.
    PassKind kind = PassKind::Raster;  // Raster, Compute or Copy
    std::vector<ParameterInfo> parameters = {};
};

/// The class that records raster passes: `"kind": "raster", "drawList": "forward"` in a file. The host registers it
/// as any other class; PlanPass::drawList and PlanPass::view tell one pass from another.
inline constexpr std::string_view drawListClass = "DrawList";

struct PlanResource;

/// Bytes that an image takes in a heap, and what its offset must be a multiple of.
struct MemoryNeed {
    std::uint64_t size = 0, alignment = 1;
};

struct HostDescription {
    rhi::Extent3D extent = {};  // of the frame; "frame" in size references
    DepthConvention depth = DepthConvention::Reversed;
    std::map<std::string, SettingValue> settings = {};  // those that differ from the defaults
    std::map<std::string, LentImport> imports = {};     // by name
    /// Exports that this host never looks at: as if the file did not have them, so that what only they need is culled
    /// (without a warning) and their images give their memory back early. A name the tree lacks is a warning (P084).
    std::vector<std::string> unwantedExports = {};
    /// Whether the device can make such an image; decides between "format" and "formatFallbacks". Empty: it can.
    /// Graph::build fills it in.
    std::function<bool(rhi::TextureFormat, rhi::TextureUsage, std::uint32_t samples)> supports = {};
    /// What the device allows of the sides of an image (2D, 3D), of its layers, and of the bytes of a buffer or of the
    /// heap; more is D002. Graph::build lowers maxSide and maxLayers to what its device allows.
    std::uint32_t maxSide = 32768, maxSide3D = 2048, maxLayers = 256;
    std::uint64_t maxBytes = 1ULL << 40;
    /// What a transient image takes in a heap. Empty: its texels' bytes, rounded up to 64 KiB. Graph::build fills it
    /// in.
    std::function<MemoryNeed(const PlanResource&)> memory = {};
    /// Pass classes that a file may name. Graph::build fills it in from its registry.
    std::vector<PassClassInfo> classes = {};
    /// For tools that look at trees of hosts they do not know: a class that is not in `classes` is taken to be one
    /// whose kind its slots tell, and its parameters are not looked at.
    bool trustClasses = false;
};

struct Plan;

/// Gives the text of an included file, or nothing when there is none of that path.
using TextReader = std::function<std::optional<std::string>(const std::string& path)>;
/// Gives the path at which a file may be found that is not beside the one that includes it.
using IncludePath = std::function<std::string(const std::string& name)>;

class PassTree {
public:
    /// Reads a tree from memory; `file` is its name in messages. What "include" names is looked up in the folder of the
    /// file that says so: by `reader`; without one nothing can be included.
    static Result<std::shared_ptr<const PassTree>> parse(std::string_view text, const std::string& file,
                                                         const TextReader& reader = {});
    /// Reads a file and what it includes: files beside it, else those at `elsewhere(name)`.
    static Result<std::shared_ptr<const PassTree>> load(const std::string& path, const IncludePath& elsewhere = {});

    const std::string& name() const;
    const std::string& file() const;
    /// Every file that was read, the tree's own first; a host that reloads on a change watches these.
    const std::vector<std::string>& files() const;
    const std::vector<SettingInfo>& settings() const;
    std::vector<std::string> drawLists() const;
    std::vector<std::string> exports() const;
    std::vector<WantedImport> imports() const;
    std::vector<std::string> passClasses() const;  // those that its passes name
    const Diagnostics& warnings() const;

    /// Links and schedules. All faults at once; warnings come with the plan.
    Result<Plan> compile(const HostDescription& host) const;

    struct Description;  // src/description.hpp: what the file says, typed
    const Description& description() const { return *description_; }
    const std::shared_ptr<const Description>& shared() const { return description_; }

private:
    std::shared_ptr<const Description> description_;
};

constexpr std::uint64_t notPlaced = ~0ULL;

/// The size of a mip level: each side halved and rounded down, at least 1. The third number of a 2D image, its layers,
/// stays.
rhi::Extent3D levelExtent(const rhi::Extent3D& extent, bool is3D, std::uint32_t level);

/// An image or buffer that the plan creates or that the host lends.
struct PlanResource {
    std::string name = {};  // "att.HairDepth", "history.Color", "host.SceneColor", "const.depthFarArray"
    /// History: what `partner` was at the end of the last frame.
    enum class Kind : std::uint8_t { Transient, History, Import, Constant } kind = Kind::Transient;
    rhi::TextureFormat format = rhi::TextureFormat::Undefined;
    rhi::Extent3D extent = {};  // of the first mip level; the third number is the depth of a 3D image, else its layers
    std::uint32_t samples = 1, layers = 1, mipLevels = 1;
    bool cube = false, is3D = false, isBuffer = false;
    rhi::TextureUsage usage = rhi::TextureUsage::None;      // gathered from the slots
    rhi::BufferUsage bufferUsage = rhi::BufferUsage::None;  // the same, of a buffer
    std::uint64_t bytes = 0;                                // of the texels, or of the buffer
    std::uint32_t firstPass = 0, lastPass = 0;              // indices into Plan::passes, both included
    std::uint32_t versions = 1;                             // states it goes through, the first being as it begins
    /// Where a transient image lies in the heap. notPlaced: buffers, imports, constants, and images with a history,
    /// whose contents outlive the frame. Two images may share bytes when their lives [firstPass, lastPass] do not meet;
    /// an exported image lives to the last pass and stays until the next frame is recorded.
    std::uint64_t heapOffset = notPlaced, heapBytes = 0;
    /// Of a History: its attachment, ~0 when no pass of this plan writes it. Of that attachment: its History.
    std::uint32_t partner = ~0U;
    rhi::Color historyClear = {};  // what a History shows in the first frame; depth in `r`
};

struct PlanSlot {
    std::string name = {}, bind = {};
    SlotAccess access = SlotAccess::Read;
    SlotUse use = SlotUse::Color;
    std::uint32_t resource = ~0U;            // ~0: optional and not connected
    std::uint32_t level = ~0U;               // the only mip level it uses; ~0: all, or a buffer
    std::uint32_t producer = ~0U;            // the pass whose result it takes, in Plan::passes; ~0: as lent or begun
    std::uint32_t reads = ~0U, makes = ~0U;  // numbers of versions of the resource; ~0: does neither
    rhi::LoadOp load = rhi::LoadOp::Load;    // of a buffer: Clear fills it with zeros
    rhi::StoreOp store = rhi::StoreOp::Store;
    rhi::Color clear = {};  // colour
    float clearDepth = 0;   // for the host's depth convention
    bool blendPremultiplied = false;
    bool depthTestAlways = false;  // fullscreen passes that write depth
};

/// The value of a class's parameter, checked against its ParameterInfo.
struct PlanParameter {
    std::string name = {};
    double number = 0;      // bool: 0 or 1; word: its index
    std::string word = {};  // of a Word
    bool operator==(const PlanParameter&) const = default;
};

struct PlanPass {
    std::string name = {}, drawList = {}, view = {}, shader = {};
    std::string passClass = {};  // not empty: recorded by this class of the host; drawListClass for a draw list
    PassKind kind = PassKind::Raster;
    bool forEachLayer = false;
    std::vector<PlanSlot> slots = {};
    std::map<std::string, double> constants = {};  // specialization constants of its shader, or for its class
    std::vector<PlanParameter> parameters = {};    // of a class: all that it declares, in that order
    std::uint32_t dispatch[3] = {1, 1, 1};         // Compute: workgroups
    std::uint32_t indirect = ~0U;                  // Compute: the slot whose buffer gives them instead; ~0: none
    std::uint32_t indirectOffset = 0;              // bytes in that buffer
};

struct Plan {
    std::vector<PlanPass> passes = {};  // in execution order
    std::vector<PlanResource> resources = {};
    std::map<std::string, std::uint32_t> exports = {};  // export name -> resource index
    std::vector<std::string> culled = {};  // "ToneMap: no export needs its result", "HairShadow: switched off …"
    std::map<std::string, std::uint32_t> viewCounts = {};
    rhi::Extent3D extent = {};  // of the frame
    DepthConvention depth = DepthConvention::Reversed;
    /// Memory of the transient images that are placed: one heap for all; what they would take each for itself; and the
    /// most that is alive at once, below which no placing can go, with the pass where that is.
    std::uint64_t heapBytes = 0, naiveBytes = 0, peakBytes = 0;
    std::uint32_t peakPass = 0;
    Diagnostics warnings = {};
    /// Graphviz text of the compiled graph.
    std::string dot() const;
};

/// The JSON schema of pass trees, which load() and parse() check with.
std::string_view passTreeSchema();

}  // namespace pelage::passes
