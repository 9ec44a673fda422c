// SPDX-License-Identifier: MIT
// A schema as a page for people: one table for each kind of object, and links where a member has a kind of its own.
#include "schema_page.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

namespace pelage::app {

namespace {

using json::Value;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.10g", value);
    return text;
}

std::string plain(const Value& value) {
    switch (value.kind) {
        case json::Kind::Null:
            return "null";
        case json::Kind::Bool:
            return value.boolean ? "true" : "false";
        case json::Kind::Number:
            return number(value.number);
        case json::Kind::String:
            return "\"" + value.string + "\"";
        case json::Kind::Array: {
            std::string out;
            for (const Value& element : value.elements) out += (out.empty() ? "" : ", ") + plain(element);
            return "[" + out + "]";
        }
        case json::Kind::Object:
            return "{}";
    }
    return {};
}

std::string code(const std::string& text) {
    return "`" + text + "`";
}

// Bars would end a cell, and what looks like a tag would be one.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string words(const Value& schema, std::string_view key) {
    const Value* found = schema.find(key);
    return found && found->isString() ? found->string : std::string();
}

class Part {
public:
    explicit Part(const Value& root) : root_(root) {
        if (const Value* defs = root.find("$defs")) definitions_ = defs;
    }

    std::string text() const {
        std::string out = object(root_);
        if (!definitions_) return out;
        for (const json::Member& each : definitions_->members) {
            out += "\n### " + each.key + "\n\n";
            const std::string about = words(each.value, "description");
            if (!about.empty()) out += sentence(about) + "\n\n";
            const Value* forms = each.value.find("properties") ? nullptr : each.value.find("oneOf");
            if (!forms) out += definition(each.value);
            for (std::size_t i = 0; forms && i < forms->elements.size(); ++i) {
                const Value& form = forms->elements[i];
                const std::string says = words(form, "description");
                out += std::string(i ? "\nOr: " : "") + (says.empty() ? std::string() : sentence(says) + "\n\n") +
                       definition(form);
            }
        }
        return out;
    }

private:
    std::string definition(const Value& schema) const {
        return schema.find("properties") ? object(schema) : "Is " + type(schema, true) + ".\n";
    }
    static std::string sentence(const std::string& text) { return text.ends_with(".") ? text : text + "."; }

    const Value* target(const Value& schema, std::string& name) const {
        const std::string reference = words(schema, "$ref");
        if (!reference.starts_with("#/$defs/") || !definitions_) return nullptr;
        name = reference.substr(8);
        return definitions_->find(name);
    }

    std::string object(const Value& schema) const {
        std::string out;
        const Value* types = schema.find("type");
        // "a number, or an object with": what it may be instead of an object.
        if (types && types->isArray()) out += "Is " + type(schema, true) + ", with the members:\n\n";
        std::set<std::string> required;
        if (const Value* list = schema.find("required")) {
            for (const Value& name : list->elements) required.insert(name.string);
        }
        out += "| member | type | default | what it says | code |\n|---|---|---|---|---|\n";
        for (const json::Member& member : schema.find("properties")->members) {
            const Value& says = member.value;
            std::string name;
            const Value* of = target(says, name);
            const Value* standard = says.find("default");
            std::string about = words(says, "description"), fault = words(says, "x-code");
            if (about.empty() && of) about = words(*of, "description");
            if (fault.empty() && of) fault = words(*of, "x-code");
            const std::string usual = required.count(member.key) ? "needed" : standard ? code(plain(*standard)) : "";
            out += "| " + code(member.key) + " | " + cell(type(says, false)) + " | " + cell(usual) + " | " +
                   cell(about) + " | " + fault + " |\n";
        }
        return out;
    }

    std::string range(const Value& schema) const {
        const Value *low = schema.find("minimum"), *above = schema.find("exclusiveMinimum"),
                    *high = schema.find("maximum");
        if (low && high) return ", " + plain(*low) + " to " + plain(*high);
        if (above && high) return ", above 0 and up to " + plain(*high);
        if (low) return ", from " + plain(*low);
        if (above) return ", above " + plain(*above);
        return high ? ", up to " + plain(*high) : std::string();
    }

    static std::string count(const Value& schema, const char* least, const char* most) {
        const Value *low = schema.find(least), *high = schema.find(most);
        if (low && high && low->number == high->number) return number(low->number);
        if (low && high) return number(low->number) + " to " + number(high->number);
        if (high) return "up to " + number(high->number);
        return low ? "at least " + number(low->number) : std::string();
    }

    std::string one(const std::string& kind, const Value& schema) const {
        if (kind == "string") {
            const std::string pattern = words(schema, "pattern");
            return pattern.empty() ? "text" : "text like " + code(pattern);
        }
        if (kind == "boolean") return "`true` or `false`";
        if (kind == "integer") return "whole number" + range(schema);
        if (kind == "number") return "number" + range(schema);
        if (kind == "array") {
            const Value* items = schema.find("items");
            const std::string many = count(schema, "minItems", "maxItems");
            return "list" + (many.empty() ? "" : " of " + many) + (items ? ": " + type(*items, false) : "");
        }
        if (kind != "object") return kind;
        const Value* each = schema.find("additionalProperties");
        if (each && each->isObject()) return "object, each member: " + type(*each, false);
        std::string out;
        if (const Value* members = schema.find("properties")) {
            for (const json::Member& member : members->members) out += (out.empty() ? "" : ", ") + code(member.key);
        }
        return out.empty() ? "object" : "object of " + out;
    }

    // `whole`: also what the definition itself is, not only its name.
    std::string type(const Value& schema, bool whole) const {
        if (schema.isBool()) return "any";
        std::string name;
        if (!whole && target(schema, name)) {
            // Anchors of pages are in lower case.
            std::string anchor = name;
            std::transform(anchor.begin(), anchor.end(), anchor.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            return "[" + name + "](#" + anchor + ")";
        }
        if (const Value* only = schema.find("const")) return code(plain(*only));
        if (const Value* list = schema.find("enum"))
            return joined(list->elements, [](const Value& v) { return code(plain(v)); });
        if (const Value* list = schema.find("oneOf"))
            return joined(list->elements, [this](const Value& v) { return type(v, false); });
        const Value* kinds = schema.find("type");
        if (!kinds) return "any";
        if (kinds->isString()) return one(kinds->string, schema);
        return joined(kinds->elements, [&](const Value& v) { return one(v.string, schema); });
    }

    template <class Use>
    static std::string joined(const std::vector<Value>& values, Use&& use) {
        std::string out;
        for (const Value& value : values) out += (out.empty() ? "" : " or ") + use(value);
        return out;
    }

    const Value& root_;
    const Value* definitions_ = nullptr;
};

}  // namespace

std::string schemaPage(const std::string& title, const std::string& command, const std::vector<SchemaPart>& parts) {
    std::string out =
        "# " + title + "\n\nWritten by `" + command +
        "` from the schema that editors and the reader use; a test compares them.\n\nThe files are strict "
        "JSON, in UTF-8, with `//` and `/* */` comments. Whatever the table, an unknown member is J010, a "
        "missing one J011, another kind of value J012, a word outside its list J013, a number outside its "
        "range J014, a name of another form J015, a list too short or long J016; the last column names a "
        "code that is used instead. All codes: [diagnostics.md](diagnostics.md).\n";
    for (const SchemaPart& part : parts) {
        out += "\n## " + (part.title.empty() ? words(part.schema.root, "title") : part.title) + "\n\n";
        const std::string about = words(part.schema.root, "description");
        if (!about.empty()) out += about + "\n\n";
        out += Part(part.schema.root).text();
    }
    for (const SchemaPart& part : parts) {
        if (part.example.empty()) continue;
        out += "\n## A whole file: " + part.exampleFile + "\n\n```json\n" + part.example;
        if (!part.example.ends_with("\n")) out += "\n";
        out += "```\n";
    }
    return out;
}

}  // namespace pelage::app
