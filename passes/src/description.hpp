// SPDX-License-Identifier: MIT
// What a pass tree file says, typed and with the places it was said at. Nothing is resolved yet: names are words.
#pragma once

#include "expression.hpp"

#include <pelage/base/json.hpp>
#include <pelage/passes/tree.hpp>

namespace pelage::passes {

using json::Place;

constexpr std::uint32_t none = ~0U;

/// A tree may come from several files. Which one a place is in rides above the bits that a line of a file of at most
/// 4 MiB needs, so that a place stays two numbers; only what shows it to people takes it apart.
constexpr std::uint32_t lineBits = 24;
inline Place inFile(Place place, std::size_t file) {
    return {place.line | (static_cast<std::uint32_t>(file) << lineBits), place.column};
}
inline std::size_t fileOf(Place place) {
    return place.line >> lineBits;
}
inline std::uint32_t lineOf(Place place) {
    return place.line & ((1U << lineBits) - 1);
}

/// Reports into one list for the files of one tree.
class Reporter {
public:
    Reporter(std::vector<std::string> files, Diagnostics& out) : files_(std::move(files)), out_(out) {}
    Reporter(const std::string& file, Diagnostics& out) : files_{file}, out_(out) {}
    void error(Place place, Code code, std::string text, std::string hint = {}) {
        add(Severity::Error, place, code, std::move(text), std::move(hint));
    }
    void warning(Place place, Code code, std::string text, std::string hint = {}) {
        add(Severity::Warning, place, code, std::move(text), std::move(hint));
    }
    /// Faults that were found elsewhere keep their codes and get this place where they have none; `context` says what
    /// was being done. What a host's own code said without a code gets `otherwise`.
    void forward(Place place, const Diagnostics& faults, const std::string& context, Code otherwise = "X001");
    bool failed() const { return out_.hasErrors(); }
    std::size_t errors() const { return errors_; }
    /// "12:5", with the file when that is not the tree's own.
    std::string at(Place place) const;

private:
    void add(Severity severity, Place place, Code code, std::string text, std::string hint);

    std::vector<std::string> files_;
    Diagnostics& out_;
    std::size_t errors_ = 0;
};

/// "did you mean 'x'?", or `otherwise` when no known name is near.
std::string didYouMean(std::string_view word, const std::vector<std::string>& known, std::string otherwise = {});

/// `Pass.slot`, `host.Import`, `att.Attachment`, `history.Attachment` or `const.name`.
struct Reference {
    enum class Root : std::uint8_t { Pass, Host, Attachment, History, Constant } root = Root::Pass;
    std::string owner = {}, member = {};  // "Resolve", "color"; for the other roots `member` is the name
    Place place = {};
    /// Set once for all when the tree has been found without fault: the pass, import, attachment or constant that is
    /// meant, and the slot of the pass. none: the file lacks it, and something else is taken instead.
    std::uint32_t index = none, slot = none;
    std::string text() const { return owner + "." + member; }
};

/// A number, or the name of a setting that gives it.
struct NumberOrSetting {
    double number = 0;
    std::string setting = {};
    Place place = {};
};

struct SettingDeclaration {
    SettingInfo info = {};
    Place place = {};
};

struct ImportDeclaration {
    enum class Kind : std::uint8_t { Image, ImageArray, ImageCube, Buffer } kind = Kind::Image;
    std::string name = {};
    SlotAccess access = SlotAccess::Read;
    std::vector<rhi::TextureFormat> formats = {};  // empty: any
    std::vector<std::uint32_t> samples = {};       // empty: any
    bool optional = false;
    Place place = {};
};

struct ViewDeclaration {
    std::string name = {};
    NumberOrSetting count = {};
    Place place = {};
};

struct SizeDeclaration {
    enum class Kind : std::uint8_t { Frame, Like, Square, Fixed } kind = Kind::Frame;
    double scale = 1;  // Frame, Like
    std::string like = {};
    std::uint32_t likeIndex = none;             // of the attachment or import
    NumberOrSetting width = {}, height = {};    // Square uses width
    std::optional<NumberOrSetting> depth = {};  // makes it 3D
    Place place = {};
};

/// Bytes of a buffer: a number, or so many for each pixel of the frame or of an image.
struct BytesDeclaration {
    NumberOrSetting count = {};
    double times = 1;
    bool perPixel = false;
    SizeDeclaration pixels = {};
    Place place = {};
};

struct AttachmentDeclaration {
    std::string name = {};
    std::vector<rhi::TextureFormat> formats = {};  // the wished one, then the fallbacks
    SizeDeclaration size = {};
    NumberOrSetting samples = {1};
    std::uint32_t layers = 1;
    std::string layersView = {};  // layers = number of these views
    std::uint32_t viewIndex = none;
    bool isBuffer = false, history = false;
    NumberOrSetting mipLevels = {1};
    bool allMipLevels = false;  // "full"
    BytesDeclaration bytes = {};
    Place place = {}, formatPlace = {}, layersPlace = {}, historyPlace = {};
};

struct SlotDeclaration {
    std::string name = {}, bind = {};
    SlotAccess access = SlotAccess::Read;
    SlotUse use = SlotUse::Color;
    bool optional = false, dontCare = false, hasClear = false, blendPremultiplied = false, depthTestAlways = false;
    bool clearIsZero = false;  // "clear": 0, of a buffer
    rhi::Color clear = {};
    enum class DepthClear : std::uint8_t { Far, Near, Number } depthClear = DepthClear::Far;
    bool clearIsDepth = false;
    float depthValue = 0;
    std::uint32_t level = none;  // of the image; none: all when it is sampled, else the first
    Place place = {}, clearPlace = {}, bindPlace = {}, levelPlace = {};

    std::vector<Reference> connect = {};  // the first that exists is taken
    Place connectPlace = {};              // of the value in "connect"; line 0: not connected
    std::optional<Reference> whenDisabled = {};
};

struct ConstantDeclaration {
    std::string name = {};
    NumberOrSetting value = {};
    Place place = {};
};

struct ShaderChoice {
    std::optional<Expression> when = {};
    std::string file = {}, otherwise = {};
    Place place = {};
};

struct OrderedAfter {
    std::string pass = {};
    Place place = {};
    std::uint32_t index = none;
};

struct ParameterDeclaration {
    std::string name = {}, word = {};
    ParameterInfo::Type type = ParameterInfo::Type::Number;
    NumberOrSetting value = {};  // a bool as 0 or 1
    Place place = {};            // of the value
    Place namePlace = {};
};

struct PassDeclaration {
    std::string name = {}, view = {}, drawList = {};
    std::string passClass = {};  // not empty: `kind` is the class's, known when the tree is compiled
    PassKind kind = PassKind::Raster;
    bool enabled = true, forEachLayer = false, sideEffects = false;
    std::optional<Expression> enabledWhen = {};
    ShaderChoice shader = {};
    std::vector<SlotDeclaration> slots = {};
    std::vector<ConstantDeclaration> constants = {};
    std::vector<OrderedAfter> after = {};
    std::vector<ParameterDeclaration> parameters = {};
    std::uint32_t viewIndex = none;
    std::uint32_t dispatch[3] = {1, 1, 1}, threads[3] = {8, 8, 1};
    std::string dispatchLike = {}, dispatchIndirect = {};
    std::uint32_t indirectOffset = 0;
    Place place = {}, namePlace = {}, viewPlace = {}, drawListPlace = {}, dispatchPlace = {}, indirectPlace = {},
          classPlace = {};

    const SlotDeclaration* slot(std::string_view word) const;
    std::vector<std::string> slotNames() const;
};

struct ExportDeclaration {
    std::string name = {};
    std::vector<Reference> from = {};
    bool optional = false;
    Place place = {}, fromPlace = {};
};

struct DrawListDeclaration {
    std::string name = {};
    Place place = {};
};

struct PassTree::Description {
    std::vector<std::string> files = {};   // by the number in a place; the tree's own first
    std::vector<std::string> onDisk = {};  // those of them that are files
    std::string name = {};
    std::vector<SettingDeclaration> settings = {};
    std::vector<SettingInfo> settingInfos = {};  // the same, as the public face gives them
    std::vector<ImportDeclaration> imports = {};
    std::vector<ViewDeclaration> views = {};
    std::vector<DrawListDeclaration> drawLists = {};
    std::vector<AttachmentDeclaration> attachments = {};
    std::vector<PassDeclaration> passes = {};
    std::vector<ExportDeclaration> exports = {};
    Diagnostics warnings = {};

    const SettingInfo* setting(std::string_view word) const;
    const ImportDeclaration* import(std::string_view word) const;
    const ViewDeclaration* view(std::string_view word) const;
    const AttachmentDeclaration* attachment(std::string_view word) const;
    const PassDeclaration* pass(std::string_view word) const;
    Vocabulary vocabulary() const;
    /// False only when no settings and imports can switch the pass off.
    bool canBeDisabled(const PassDeclaration& pass) const;
};

/// The stand-ins every frame has.
const std::vector<std::string>& constantNames();

template <class T>
std::vector<std::string> namesOf(const std::vector<T>& items) {
    std::vector<std::string> names;
    for (const T& item : items) names.push_back(item.name);
    return names;
}

}  // namespace pelage::passes
