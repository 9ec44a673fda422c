// SPDX-License-Identifier: MIT
#include "reader.hpp"

#include <algorithm>
#include <cmath>

namespace pelage::passes {

using json::Member;
using json::Value;

std::string wordOf(const Value& object, std::string_view key, std::string otherwise) {
    const Value* value = object.find(key);
    return value && value->isString() ? value->string : std::move(otherwise);
}

bool flagOf(const Value& object, std::string_view key, bool otherwise) {
    const Value* value = object.find(key);
    return value && value->isBool() ? value->boolean : otherwise;
}

Place placeOf(const Value& object, std::string_view key) {
    const Value* value = object.find(key);
    return value ? value->place : object.place;
}

std::uint32_t wholeNumber(double number, std::uint32_t otherwise) {
    if (!(number >= 0 && number <= 4294967295.0) || std::floor(number) != number) return otherwise;
    return static_cast<std::uint32_t>(number);
}

NumberOrSetting numberOrSetting(const Value& value) {
    if (value.isObject()) return {0, wordOf(value, "setting"), placeOf(value, "setting")};
    if (value.isBool()) return {value.boolean ? 1.0 : 0.0, {}, value.place};
    return {value.isNumber() ? value.number : 0, {}, value.place};
}

SlotAccess accessOf(const Value& object) {
    const std::string word = wordOf(object, "access");
    return word == "write" ? SlotAccess::Write : word == "readWrite" ? SlotAccess::ReadWrite : SlotAccess::Read;
}

namespace {

bool isName(std::string_view word) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (word.empty() || word.size() > 63 || !letter(word.front())) return false;
    return std::all_of(word.begin(), word.end(),
                       [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

void readReference(const Value& value, std::vector<Reference>& out, Reporter& reporter) {
    Reference reference{.place = value.place};
    const std::size_t dot = value.isString() ? value.string.find('.') : std::string::npos;
    if (dot != std::string::npos) {
        reference.owner = value.string.substr(0, dot);
        reference.member = value.string.substr(dot + 1);
    }
    if (!isName(reference.owner) || !isName(reference.member)) {
        reporter.error(value.place, "P015", "'" + value.string + "' is not a reference",
                       R"(write "Pass.slot", "host.Name", "att.Name", "history.Name" or "const.name")");
        return;
    }
    using Root = Reference::Root;
    reference.root = reference.owner == "host"      ? Root::Host
                     : reference.owner == "att"     ? Root::Attachment
                     : reference.owner == "history" ? Root::History
                     : reference.owner == "const"   ? Root::Constant
                                                    : Root::Pass;
    out.push_back(std::move(reference));
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

class SettingReader {
public:
    SettingReader(const Member& member, Reporter& reporter) : member_(member), reporter_(reporter) {}

    SettingDeclaration read() {
        const Value& value = member_.value;
        SettingInfo info;
        info.name = member_.key;
        info.description = wordOf(value, "description");
        const std::string type = wordOf(value, "type");
        info.type = type == "bool"   ? SettingValue::Type::Bool
                    : type == "enum" ? SettingValue::Type::Enum
                                     : SettingValue::Type::Uint;
        info.defaultValue.type = info.type;
        if (info.type == SettingValue::Type::Uint) {
            forbid({"values"}, type);
            readUint(value, info);
        } else if (info.type == SettingValue::Type::Enum) {
            forbid({"min", "max", "multipleOf"}, type);
            readEnum(value, info);
        } else {
            forbid({"min", "max", "multipleOf", "values"}, type);
            const Value* standard = value.find("default");
            if (standard && standard->isBool()) {
                info.defaultValue.number = standard->boolean ? 1 : 0;
            } else {
                wrongDefault("true or false");
            }
        }
        return {std::move(info), member_.place};
    }

private:
    void forbid(std::initializer_list<std::string_view> keys, const std::string& type) {
        for (const std::string_view key : keys) {
            if (const Member* found = member_.value.member(key)) {
                reporter_.error(
                    found->place, "P040",
                    "setting '" + member_.key + "' of type " + type + " has no \"" + std::string(key) + "\"",
                    "remove it");
            }
        }
    }
    void wrongDefault(const std::string& expected, std::string hint = {}) {
        reporter_.error(placeOf(member_.value, "default"), "P005",
                        "default of setting '" + member_.key + "' must be " + expected, std::move(hint));
    }

    void readUint(const Value& value, SettingInfo& info) {
        const auto number = [&](std::string_view key, std::uint32_t otherwise) {
            const Value* found = value.find(key);
            return found && found->isNumber() ? wholeNumber(found->number, otherwise) : otherwise;
        };
        info.min = number("min", 0);
        info.max = number("max", ~0U);
        info.multipleOf = std::max(1U, number("multipleOf", 1));
        if (info.min > info.max) {
            reporter_.error(placeOf(value, "min"), "P006",
                            "setting '" + info.name + "' has min " + std::to_string(info.min) + " above max " +
                                std::to_string(info.max));
            return;
        }
        const Value* standard = value.find("default");
        const double given = standard && standard->isNumber() ? standard->number : -1;
        info.defaultValue.number = wholeNumber(given);
        const std::uint32_t set = info.defaultValue.number;
        if (given != static_cast<double>(set) || set < info.min || set > info.max || set % info.multipleOf != 0) {
            wrongDefault("a whole number in " + std::to_string(info.min) + ".." + std::to_string(info.max) +
                         (info.multipleOf > 1 ? ", a multiple of " + std::to_string(info.multipleOf) : ""));
        }
    }

    void readEnum(const Value& value, SettingInfo& info) {
        if (const Value* words = value.find("values")) {
            for (const Value& word : words->elements) info.words.push_back(word.string);
        }
        if (info.words.empty()) {
            reporter_.error(value.place, "P007", "enum setting '" + info.name + "' has no \"values\"");
            return;
        }
        info.defaultValue.word = wordOf(value, "default");
        const auto found = std::find(info.words.begin(), info.words.end(), info.defaultValue.word);
        if (found == info.words.end()) {
            wrongDefault("one of " + listed(info.words), didYouMean(info.defaultValue.word, info.words));
            return;
        }
        info.defaultValue.number = static_cast<std::uint32_t>(found - info.words.begin());
    }

    const Member& member_;
    Reporter& reporter_;
};

ImportDeclaration readImport(const Member& member) {
    const Value& value = member.value;
    ImportDeclaration import{.name = member.key, .access = accessOf(value), .place = member.place};
    const std::string kind = wordOf(value, "kind");
    import.kind = kind == "imageArray"  ? ImportDeclaration::Kind::ImageArray
                  : kind == "imageCube" ? ImportDeclaration::Kind::ImageCube
                  : kind == "buffer"    ? ImportDeclaration::Kind::Buffer
                                        : ImportDeclaration::Kind::Image;
    import.optional = flagOf(value, "optional", false);
    if (const Value* formats = value.find("formats")) {
        for (const Value& format : formats->elements)
            import.formats.push_back(rhi::textureFormatFromName(format.string));
    }
    if (const Value* samples = value.find("samples")) {
        for (const Value& count : samples->elements) import.samples.push_back(wholeNumber(count.number, 1));
    }
    return import;
}

SizeDeclaration readSize(const Value& value, const std::string& about, Reporter& reporter) {
    SizeDeclaration size{.place = value.place};
    int ways = 0;
    using Kind = SizeDeclaration::Kind;
    if (const Value* frame = value.find("frame")) {
        ++ways, size.kind = Kind::Frame, size.scale = frame->number;
    }
    if (const Value* like = value.find("like")) {
        ++ways, size.kind = Kind::Like, size.like = like->string, size.place = like->place;
        if (const Value* scale = value.find("scale")) size.scale = scale->number;
    } else if (const Member* scale = value.member("scale")) {
        reporter.error(scale->place, "P025", about + ": \"scale\" goes with \"like\"", "write \"frame\": scale");
    }
    if (const Value* square = value.find("square")) {
        ++ways, size.kind = Kind::Square, size.width = numberOrSetting(*square);
    }
    if (const Value* fixed = value.find("fixed")) {
        ++ways, size.kind = Kind::Fixed;
        if (fixed->elements.size() == 2) {
            size.width = numberOrSetting(fixed->elements[0]);
            size.height = numberOrSetting(fixed->elements[1]);
        }
    }
    if (const Value* depth = value.find("depth")) size.depth = numberOrSetting(*depth);
    if (ways != 1) reporter.error(value.place, "P025", about + " needs exactly one of frame, like, square and fixed");
    return size;
}

BytesDeclaration readBytes(const Value& value, const std::string& about, Reporter& reporter) {
    BytesDeclaration bytes{.place = value.place};
    if (!value.isObject()) {
        bytes.count = numberOrSetting(value);
        return bytes;
    }
    const Value* setting = value.find("setting");
    const Value* perPixel = value.find("perPixel");
    const Value* like = value.find("like");
    if ((setting != nullptr) == (perPixel != nullptr)) {
        reporter.error(value.place, "P056", about + " needs a number, or exactly one of setting and perPixel");
        return bytes;
    }
    if (like && !perPixel) reporter.error(like->place, "P056", about + R"(: "like" goes with "perPixel")", "remove it");
    if (setting) bytes.count = numberOrSetting(value);
    if (perPixel) {
        bytes.perPixel = true;
        bytes.count = {1, {}, value.place};
        bytes.times = perPixel->number;
        if (like) bytes.pixels = {.kind = SizeDeclaration::Kind::Like, .like = like->string, .place = like->place};
    }
    if (const Value* times = value.find("times")) {
        if (perPixel) reporter.error(times->place, "P056", about + R"(: "times" goes with "setting")", "remove it");
        bytes.times = times->number;
    }
    return bytes;
}

// What only images or only buffers have.
void membersOfKind(const Member& attachment, bool buffer, Reporter& reporter) {
    const std::string title = "attachment '" + attachment.key + "' is " + (buffer ? "a buffer" : "an image");
    for (const char* key : {"format", "size", "formatFallbacks", "samples", "layers", "mipLevels"}) {
        const Member* found = attachment.value.member(key);
        if (buffer && found)
            reporter.error(found->place, "P056", title + ": it has no \"" + std::string(key) + "\"", "remove it");
    }
    if (const Member* bytes = attachment.value.member("bytes"); bytes && !buffer)
        reporter.error(bytes->place, "P056", title + ": it has no \"bytes\"", R"(add "kind": "buffer", or remove it)");
    for (const char* key : {"format", "size"}) {
        if (!buffer && !attachment.value.find(key))
            reporter.error(attachment.value.place, "J011",
                           "attachments['" + attachment.key + "'] has no \"" + std::string(key) + "\"");
    }
    if (buffer && !attachment.value.find("bytes"))
        reporter.error(attachment.value.place, "J011", "attachments['" + attachment.key + "'] has no \"bytes\"");
}

AttachmentDeclaration readAttachment(const Member& member, Reporter& reporter) {
    const Value& value = member.value;
    AttachmentDeclaration attachment{.name = member.key, .place = member.place};
    attachment.isBuffer = wordOf(value, "kind") == "buffer";
    const Value* history = value.find("history");
    attachment.history = history && history->number > 0;
    attachment.historyPlace = placeOf(value, "history");
    membersOfKind(member, attachment.isBuffer, reporter);
    if (const Value* bytes = value.find("bytes"))
        attachment.bytes = readBytes(*bytes, "size of 'att." + member.key + "'", reporter);
    attachment.formats.push_back(rhi::textureFormatFromName(wordOf(value, "format")));
    attachment.formatPlace = placeOf(value, "format");
    if (const Value* others = value.find("formatFallbacks")) {
        for (const Value& other : others->elements) {
            attachment.formats.push_back(rhi::textureFormatFromName(other.string));
            if (rhi::isDepth(attachment.formats.back()) != rhi::isDepth(attachment.formats.front())) {
                reporter.error(other.place, "P026",
                               "a colour format and a depth format cannot stand in for each other");
            }
        }
    }
    attachment.size.place = value.place;
    if (const Value* size = value.find("size"))
        attachment.size = readSize(*size, "size of 'att." + member.key + "'", reporter);
    if (const Value* samples = value.find("samples")) attachment.samples = numberOrSetting(*samples);
    if (attachment.samples.place.line == 0) attachment.samples.place = member.place;
    attachment.mipLevels.place = member.place;
    if (const Value* levels = value.find("mipLevels")) {
        attachment.mipLevels = numberOrSetting(*levels);
        attachment.allMipLevels = levels->isString();
        if (levels->isString() && levels->string != "full") {
            reporter.error(levels->place, "P061",
                           "mipLevels of 'att." + member.key + "' cannot be '" + levels->string + "'",
                           didYouMean(levels->string, {"full"}, "write a number, or \"full\""));
        }
    }
    attachment.layersPlace = placeOf(value, "layers");
    if (const Value* layers = value.find("layers")) {
        if (layers->isObject()) {
            attachment.layersView = wordOf(*layers, "view");
            attachment.layersPlace = placeOf(*layers, "view");
        } else {
            attachment.layers = std::max(1U, wholeNumber(layers->number, 1));
        }
    }
    return attachment;
}

}  // namespace

std::vector<Reference> readReferences(const Value& value, Reporter& reporter) {
    std::vector<Reference> references;
    if (value.isArray()) {
        for (const Value& element : value.elements) readReference(element, references, reporter);
    } else {
        readReference(value, references, reporter);
    }
    return references;
}

std::shared_ptr<PassTree::Description> readDescription(const Source& source, Diagnostics& out) {
    const Value& root = source.root;
    auto description = std::make_shared<PassTree::Description>();
    Reporter reporter(source.files, out);
    description->files = source.files;
    description->onDisk = source.onDisk;
    description->name = wordOf(root, "name");
    forEachMember(root, "settings", [&](const Member& member) {
        description->settings.push_back(SettingReader(member, reporter).read());
        description->settingInfos.push_back(description->settings.back().info);
    });
    // Conditions would be judged by settings that are not understood.
    if (reporter.failed()) return description;
    forEachMember(root, "imports", [&](const Member& member) { description->imports.push_back(readImport(member)); });
    forEachMember(root, "views", [&](const Member& member) {
        ViewDeclaration view{.name = member.key, .count = {}, .place = member.place};
        if (const Value* count = member.value.find("count")) view.count = numberOrSetting(*count);
        description->views.push_back(std::move(view));
    });
    if (const Value* lists = root.find("drawLists")) {
        for (const Value& list : lists->elements) description->drawLists.push_back({list.string, list.place});
    }
    forEachMember(root, "attachments",
                  [&](const Member& member) { description->attachments.push_back(readAttachment(member, reporter)); });
    readPasses(root, *description, reporter);
    forEachMember(root, "exports", [&](const Member& member) {
        ExportDeclaration made{
            .name = member.key, .optional = flagOf(member.value, "optional", false), .place = member.place};
        made.fromPlace = placeOf(member.value, "from");
        if (const Value* from = member.value.find("from")) made.from = readReferences(*from, reporter);
        description->exports.push_back(std::move(made));
    });
    return description;
}

}  // namespace pelage::passes
