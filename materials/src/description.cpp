// SPDX-License-Identifier: MIT
#include "description.hpp"

namespace pelage::materials {
namespace {

using json::Member;

Word word(const json::Value& value) {
    return {value.string, value.place};
}
Word key(const Member& member) {
    return {member.key, member.place};
}

std::string text(const json::Value& object, std::string_view key) {
    const json::Value* value = object.find(key);
    return value ? value->string : std::string();
}
std::optional<Word> optionalWord(const json::Value& object, std::string_view key) {
    const json::Value* value = object.find(key);
    if (!value) return {};
    return word(*value);
}
std::optional<double> number(const json::Value& object, std::string_view key) {
    const json::Value* value = object.find(key);
    if (!value) return {};
    return value->number;
}
std::int64_t whole(const json::Value& object, std::string_view key, std::int64_t otherwise) {
    const json::Value* value = object.find(key);
    return value ? static_cast<std::int64_t>(value->number) : otherwise;  // the schema bounds it
}
std::vector<std::string> words(const json::Value* list) {
    std::vector<std::string> out;
    if (!list) return out;
    for (const json::Value& element : list->elements) out.push_back(element.string);
    return out;
}
// The members of an object that may be absent.
const std::vector<Member>& membersOf(const json::Value& object, std::string_view key, const std::vector<Member>& none) {
    const json::Value* value = object.find(key);
    return value ? value->members : none;
}
const std::vector<json::Value>& elementsOf(const json::Value& object, std::string_view key,
                                           const std::vector<json::Value>& none) {
    const json::Value* value = object.find(key);
    return value ? value->elements : none;
}

// "longitudinalRoughness" reads "Longitudinal roughness" where no label is given.
std::string labelFromName(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const bool isUpper = c >= 'A' && c <= 'Z';
        if (isUpper && !out.empty()) out += ' ';
        out += isUpper ? static_cast<char>(c - 'A' + 'a') : c;
    }
    if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
    return out;
}

PropertyDescription describeProperty(const json::Value& group, const json::Value& value) {
    PropertyDescription out;
    Property& property = out.property;
    out.name = word(*value.find("name"));
    property.group = text(group, "name");
    property.groupLabel = group.find("label") ? text(group, "label") : labelFromName(property.group);
    property.name = out.name.text;
    property.id = property.group + "." + property.name;
    property.label = value.find("label") ? text(value, "label") : labelFromName(property.name);
    property.description = text(value, "description");
    property.unit = text(value, "unit");
    valueTypeFromName(text(value, "type"), property.type);
    property.min = number(value, "min");
    property.max = number(value, "max");
    property.softMin = number(value, "softMin");
    property.softMax = number(value, "softMax");
    property.step = number(value, "step");
    property.words = words(value.find("values"));
    property.srgb = text(value, "space") == "srgb";
    property.visibleWhen = text(value, "visibleWhen");
    property.enabledWhen = text(value, "enabledWhen");
    out.visibleWhen = optionalWord(value, "visibleWhen");
    out.enabledWhen = optionalWord(value, "enabledWhen");
    out.groupVisibleWhen = optionalWord(group, "visibleWhen");
    if (const json::Value* list = value.find("values"); list && list->isString()) out.wordsOf = word(*list);
    if (const json::Value* connect = value.find("connect"); connect && !connect->members.empty())
        out.connect = PropertyDescription::Connect{connect->members[0].key, word(connect->members[0].value)};
    out.defaultValue = value.find("default");
    for (const std::string_view bound : {"min", "max", "softMin", "softMax"}) {
        if (!out.min) out.min = value.find(bound);
    }
    return out;
}

OptionDescription describeOption(const Member& member) {
    OptionDescription out;
    const json::Value& value = member.value;
    out.name = key(member);
    out.option.name = member.key;
    if (const json::Value* list = value.find("values")) {
        out.option.type = ValueType::Enum;
        out.option.words = words(list);
        if (list->isString()) out.wordsOf = word(*list);
    } else if (text(value, "type") == "int") {
        out.option.type = ValueType::Int;
        out.option.min = whole(value, "min", 0);
        out.option.max = whole(value, "max", 1);
    }
    out.defaultValue = value.find("default");
    return out;
}

RenderState describeState(const json::Value& value) {
    RenderState out;
    const std::string cull = text(value, "cull"), depth = text(value, "depthTest"), blend = text(value, "blend");
    if (cull == "front") out.cull = rhi::CullMode::Front;
    if (cull == "back") out.cull = rhi::CullMode::Back;
    if (depth == "never") out.depthTest = DepthTest::Never;
    if (depth == "nearer") out.depthTest = DepthTest::Nearer;
    if (depth == "equal") out.depthTest = DepthTest::Equal;
    if (depth == "always") out.depthTest = DepthTest::Always;
    if (blend == "premultiplied") out.blend = Blend::Premultiplied;
    if (blend == "additive") out.blend = Blend::Additive;
    if (const json::Value* write = value.find("depthWrite")) out.depthWrite = write->boolean;
    if (const json::Value* coverage = value.find("alphaToCoverage")) out.alphaToCoverage = coverage->boolean;
    return out;
}

ShaderDescription describeShader(const Member& member) {
    ShaderDescription out;
    const json::Value& value = member.value;
    out.name = key(member);
    out.shader.name = member.key;
    out.shader.drawList = text(value, "drawList");
    out.drawList = value.find("drawList")->place;
    out.shader.vertex = text(value, "vertex");
    out.shader.fragment = text(value, "fragment");
    out.shader.compute = text(value, "compute");
    if (const json::Value* enabled = value.find("enabled")) out.shader.enabledByDefault = enabled->boolean;
    if (const json::Value* state = value.find("state")) out.shader.state = describeState(*state);
    if (const json::Value* options = value.find("options")) {
        out.allOptions = options->isString();
        for (const json::Value& element : options->elements) out.options.push_back(word(element));
    }
    return out;
}

FunctorDescription describeFunctor(const json::Value& value) {
    FunctorDescription out;
    out.id = word(*value.find("id"));
    out.type = word(*value.find("type"));
    const json::Value& in = *value.find("in");
    const json::Value& outs = *value.find("out");
    out.inPlace = in.place;
    out.outPlace = outs.place;
    for (const Member& member : in.members) out.in.push_back({key(member), word(member.value)});
    for (const Member& member : outs.members) out.out.push_back({key(member), word(member.value)});
    return out;
}

VersionDescription describeVersion(const json::Value& value) {
    VersionDescription out;
    out.to = whole(value, "to", 2);
    out.place = value.find("to")->place;
    using Kind = VersionAction::Kind;
    for (const json::Value& action : value.find("actions")->elements) {
        const std::string op = text(action, "op");
        const json::Value& property = *action.find(op == "rename" ? "from" : "property");
        VersionDescription::Action& described = out.actions.emplace_back();
        described.whole = action.place;
        described.property = property.place;
        described.action.kind = op == "rename"        ? Kind::Rename
                                : op == "setValue"    ? Kind::SetValue
                                : op == "remove"      ? Kind::Remove
                                : op == "renameWords" ? Kind::RenameWords
                                                      : Kind::Remap;
        described.action.property = property.string;
        if (const json::Value* to = action.find("to")) {
            described.action.to = to->string;
            described.to = to->place;
        }
        if (const json::Value* set = action.find("value")) {
            described.action.value = *set;
            described.value = set->place;
        }
        if (const json::Value* renamed = action.find("words")) {
            for (const Member& each : renamed->members) described.action.words[each.key] = each.value.string;
            described.value = renamed->place;
        }
        if (const json::Value* scale = action.find("scale")) described.action.scale = scale->number;
        if (const json::Value* offset = action.find("offset")) described.action.offset = offset->number;
    }
    return out;
}

}  // namespace

TypeDescription describe(const json::Document& document) {
    const json::Value& root = document.root;
    const std::vector<Member> noMembers;
    const std::vector<json::Value> noElements;
    TypeDescription out;
    out.file = document.file;
    out.name = text(root, "name");
    out.version = static_cast<int>(whole(root, "version", 1));
    for (const json::Value& group : elementsOf(root, "groups", noElements)) {
        out.groups.push_back(word(*group.find("name")));
        for (const json::Value& property : elementsOf(group, "properties", noElements))
            out.properties.push_back(describeProperty(group, property));
    }
    for (const Member& member : membersOf(root, "inputs", noMembers)) {
        InputDescription input;
        input.name = key(member);
        input.input.name = member.key;
        const bool isObject = member.value.isObject();
        valueTypeFromName(isObject ? text(member.value, "type") : member.value.string, input.input.type);
        input.input.srgb = isObject && text(member.value, "space") == "srgb";
        out.inputs.push_back(std::move(input));
    }
    for (const Member& member : membersOf(root, "options", noMembers)) out.options.push_back(describeOption(member));
    for (const Member& member : membersOf(root, "shaders", noMembers)) out.shaders.push_back(describeShader(member));
    for (const json::Value& functor : elementsOf(root, "functors", noElements))
        out.functors.push_back(describeFunctor(functor));
    for (const Member& member : membersOf(root, "presets", noMembers)) {
        PresetDescription preset{key(member), {}};
        for (const Member& value : member.value.members) preset.values.push_back({key(value), &value.value});
        out.presets.push_back(std::move(preset));
    }
    for (const json::Value& update : elementsOf(root, "versionUpdates", noElements))
        out.versions.push_back(describeVersion(update));
    return out;
}

}  // namespace pelage::materials
