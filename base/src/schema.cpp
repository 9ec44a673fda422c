// SPDX-License-Identifier: MIT
#include "schema_subset.hpp"
#include "schema_words.hpp"

#include <pelage/base/json.hpp>

#include <algorithm>
#include <cmath>

namespace pelage::json {
namespace {

constexpr int deepestSchema = 512;               // against a $ref that leads to itself
constexpr std::size_t longestPatternText = 256;  // std::regex recurses once per character

class Validator {
public:
    Validator(const Document& schema, const Patterns& patterns, const Document& document)
        : schema_(schema), patterns_(patterns), document_(document) {}

    Diagnostics run() {
        check(schema_.root, document_.root, {});
        out_.sortByPlace();
        return std::move(out_);
    }

private:
    struct Step {
        std::string_view key = {};  // member of an object
        std::size_t index = 0;      // or element of an array
        const Value* element = nullptr;
    };
    struct Context {
        Code code = {};
        std::string_view hint = {};  // "x-code" and "x-hint" hold for everything below them
    };

    std::string path() const {
        std::string out;
        for (const Step& step : steps_) {
            if (step.element) {
                const Value* name = step.element->find("name");
                if (!name) name = step.element->find("id");
                out += '[';
                out += name && name->isString() ? "'" + name->string + "'" : std::to_string(step.index);
                out += ']';
            } else if (step.key.find_first_of(".[' ") != std::string_view::npos || step.key.empty()) {
                out += "['" + std::string(step.key) + "']";
            } else {
                if (!out.empty()) out += '.';
                out += step.key;
            }
        }
        return out.empty() ? "the document" : out;
    }

    void report(Place place, Code code, const Context& context, std::string text, std::string hint = {}) {
        if (muted_) {
            failed_ = true;
            return;
        }
        out_.add({Severity::Error, context.code.empty() ? code : context.code, document_.file, place.line, place.column,
                  std::move(text), context.hint.empty() ? std::move(hint) : std::string(context.hint)});
    }

    // Whether `value` fits, without saying why not.
    bool fits(const Value& schema, const Value& value) {
        const bool wasMuted = muted_, hadFailed = failed_;
        muted_ = true;
        failed_ = false;
        check(schema, value, {});
        const bool result = !failed_;
        muted_ = wasMuted;
        failed_ = hadFailed;
        return result;
    }

    const Value& follow(const Value& schema) const {
        const Value* at = &schema;
        for (int hops = 0; hops < 16; ++hops) {
            const Value* reference = at->find("$ref");
            const Value* target = reference ? resolveReference(schema_.root, reference->string) : nullptr;
            if (!target) break;
            at = target;
        }
        return *at;
    }

    void check(const Value& schema, const Value& value, Context context) {
        if (muted_ && failed_) return;
        if (schema.isBool()) {
            if (!schema.boolean) report(value.place, "J019", context, path() + " is not allowed here", "remove it");
            return;
        }
        if (depth_ > deepestSchema) return;
        ++depth_;
        if (const Value* code = schema.find("x-code")) context.code = Code::find(code->string).value_or(Code());
        if (const Value* hint = schema.find("x-hint")) context.hint = hint->string;
        if (const Value* reference = schema.find("$ref")) {
            if (const Value* target = resolveReference(schema_.root, reference->string)) check(*target, value, context);
        }
        if (checkType(schema, value, context)) {
            checkWords(schema, value, context);
            switch (value.kind) {
                case Kind::Object:
                    checkObject(schema, value, context);
                    break;
                case Kind::Array:
                    checkArray(schema, value, context);
                    break;
                case Kind::Number:
                    checkNumber(schema, value, context);
                    break;
                case Kind::String:
                    checkString(schema, value, context);
                    break;
                default:
                    break;
            }
            checkCombinations(schema, value, context);
        }
        --depth_;
    }

    bool checkType(const Value& schema, const Value& value, const Context& context) {
        const Value* type = schema.find("type");
        if (!type) return true;
        std::vector<std::string_view> wanted;
        if (type->isString()) wanted.push_back(type->string);
        for (const Value& element : type->elements) wanted.push_back(element.string);
        if (std::any_of(wanted.begin(), wanted.end(), [&](std::string_view word) { return isOfType(value, word); }))
            return true;
        std::string text = path() + " must be ";
        for (std::size_t i = 0; i < wanted.size(); ++i)
            text += (i == 0 ? "" : i + 1 == wanted.size() ? " or " : ", ") + std::string(describe(wanted[i]));
        text += ", found ";
        text += value.isNumber() && wanted.size() == 1 && wanted[0] == "integer" ? shown(value)
                                                                                 : std::string(describe(value.kind));
        report(value.place, "J012", context, std::move(text), typeHint(value, wanted));
        return false;
    }

    void checkWords(const Value& schema, const Value& value, const Context& context) {
        if (const Value* only = schema.find("const"); only && !equal(*only, value)) {
            const bool isVersion = context.code == "J020";
            report(value.place, "J018", context,
                   path() + (isVersion ? " is " + shown(value) + "; this build reads " + shown(*only)
                                       : " must be " + shown(*only) + ", found " + shown(value)));
        }
        const Value* words = schema.find("enum");
        if (!words || std::any_of(words->elements.begin(), words->elements.end(),
                                  [&](const Value& word) { return equal(word, value); }))
            return;
        std::vector<std::string> known;
        for (const Value& word : words->elements) known.push_back(word.isString() ? word.string : shown(word));
        report(value.place, "J013", context, shown(value) + " is not a value of " + path(),
               nameHint(value.isString() ? std::string_view(value.string) : std::string_view(), known));
    }

    void checkCount(const Value& schema, std::string_view least, std::string_view most, std::size_t count,
                    std::string_view what, const Value& value, const Context& context) {
        const Value* low = schema.find(least);
        const Value* high = schema.find(most);
        const auto size = static_cast<double>(count);
        const bool tooFew = low && size < low->number, tooMany = high && size > high->number;
        if (!tooFew && !tooMany) return;
        const double bound = tooFew ? low->number : high->number;
        const std::string side = low && high && low->number == high->number ? "exactly "
                                 : tooFew                                   ? "at least "
                                                                            : "at most ";
        report(value.place, "J016", context,
               path() + " needs " + side + shown(bound) + " " + std::string(what) + ", found " + std::to_string(count));
    }

    void checkObject(const Value& schema, const Value& value, const Context& context) {
        if (const Value* required = schema.find("required")) {
            for (const Value& key : required->elements) {
                if (!value.find(key.string) && !isMisspelt(schema, value, key.string))
                    report(value.place, "J011", context, path() + " has no " + quoted(key.string), "add it");
            }
        }
        checkCount(schema, "minProperties", "maxProperties", value.members.size(), "members", value, context);
        const Value* properties = schema.find("properties");
        const Value* additional = schema.find("additionalProperties");
        const Value* names = schema.find("propertyNames");
        for (const Member& member : value.members) {
            const Value* known = properties ? properties->find(member.key) : nullptr;
            if (names && !known) {
                Value key;
                key.kind = Kind::String;
                key.place = member.place;
                key.string = member.key;
                checkIn({member.key}, *names, key, context);
            }
            if (known) {
                checkIn({member.key}, *known, member.value, context);
            } else if (additional && additional->isBool() && !additional->boolean) {
                std::vector<std::string> keys;
                if (properties) {
                    for (const Member& property : properties->members) keys.push_back(property.key);
                }
                report(member.place, "J010", context, "unknown key " + quoted(member.key) + " in " + path(),
                       nameHint(member.key, keys));
            } else if (additional) {
                checkIn({member.key}, *additional, member.value, context);
            }
        }
    }

    // A misspelt required key is one mistake: it is reported as unknown, with the right spelling as the hint.
    static bool isMisspelt(const Value& schema, const Value& value, std::string_view key) {
        const Value* properties = schema.find("properties");
        const Value* additional = schema.find("additionalProperties");
        if (!properties || !additional || !additional->isBool() || additional->boolean) return false;
        std::vector<std::string> keys;
        for (const Member& property : properties->members) keys.push_back(property.key);
        return std::any_of(value.members.begin(), value.members.end(), [&](const Member& member) {
            return !properties->find(member.key) && nearestName(member.key, keys) == key;
        });
    }

    void checkIn(Step step, const Value& schema, const Value& value, const Context& context) {
        steps_.push_back(step);
        check(schema, value, context);
        steps_.pop_back();
    }

    void checkArray(const Value& schema, const Value& value, const Context& context) {
        checkCount(schema, "minItems", "maxItems", value.elements.size(), "elements", value, context);
        const Value* first = schema.find("prefixItems");
        const Value* items = schema.find("items");
        for (std::size_t i = 0; i < value.elements.size(); ++i) {
            const Value* wanted = first && i < first->elements.size() ? &first->elements[i] : items;
            if (wanted) checkIn({{}, i, &value.elements[i]}, *wanted, value.elements[i], context);
        }
        const Value* unique = schema.find("uniqueItems");
        if (!unique || !unique->boolean || value.elements.size() > 1024) return;
        for (std::size_t i = 1; i < value.elements.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                if (!equal(value.elements[i], value.elements[k])) continue;
                const Place earlier = value.elements[k].place;
                report(value.elements[i].place, "J017", context,
                       shown(value.elements[i]) + " stands twice in " + path(),
                       "first at " + std::to_string(earlier.line) + ":" + std::to_string(earlier.column));
                break;
            }
        }
    }

    void checkNumber(const Value& schema, const Value& value, const Context& context) {
        const double number = value.number;
        const auto breaks = [&](std::string_view keyword, auto wrong, std::string_view words) {
            const Value* bound = schema.find(keyword);
            if (bound && wrong(bound->number))
                report(value.place, "J014", context,
                       path() + " is " + shown(value) + ", must be " + std::string(words) + " " + shown(*bound));
        };
        breaks(
            "minimum", [&](double bound) { return number < bound; }, "at least");
        breaks(
            "maximum", [&](double bound) { return number > bound; }, "at most");
        breaks(
            "exclusiveMinimum", [&](double bound) { return number <= bound; }, "more than");
        breaks(
            "multipleOf", [&](double bound) { return bound > 0 && std::fmod(number, bound) != 0; }, "a multiple of");
    }

    void checkString(const Value& schema, const Value& value, const Context& context) {
        checkCount(schema, "minLength", "maxLength", value.string.size(), "bytes", value, context);
        const Value* pattern = schema.find("pattern");
        if (!pattern || matches(pattern->string, value.string)) return;
        report(value.place, "J015", context, quoted(value.string) + " is not of the right form for " + path(),
               "must match " + pattern->string);
    }

    bool matches(const std::string& pattern, const std::string& text) const {
        const auto compiled = patterns_.find(pattern);
        if (text.size() > longestPatternText || compiled == patterns_.end()) return false;
        try {
            return std::regex_search(text, compiled->second);
        } catch (const std::regex_error&) {  // too complex for this text
            return false;
        }
    }

    void checkCombinations(const Value& schema, const Value& value, const Context& context) {
        if (const Value* all = schema.find("allOf")) {
            for (const Value& part : all->elements) check(part, value, context);
        }
        if (const Value* condition = schema.find("if")) {
            if (const Value* branch = schema.find(fits(*condition, value) ? "then" : "else"))
                check(*branch, value, context);
        }
        if (const Value* forbidden = schema.find("not"); forbidden && fits(*forbidden, value))
            report(value.place, "J019", context, path() + " is not allowed here", "remove it");
        for (const std::string_view keyword : {"oneOf", "anyOf"}) {
            if (const Value* branches = schema.find(keyword)) checkBranches(schema, *branches, keyword, value, context);
        }
    }

    void checkBranches(const Value& schema, const Value& branches, std::string_view keyword, const Value& value,
                       const Context& context) {
        std::size_t fitting = 0;
        for (const Value& branch : branches.elements) fitting += fits(branch, value) ? 1 : 0;
        if (fitting == 1 || (fitting > 1 && keyword == "anyOf")) return;
        if (const Value* error = schema.find("x-error"))
            return report(value.place, Code::find(error->elements[0].string).value_or(Code()), {{}, context.hint},
                          path() + " " + error->elements[1].string);
        if (fitting > 1) return report(value.place, "J021", context, path() + " fits more than one of its forms");
        if (const Value* branch = intended(branches, value)) return check(*branch, value, context);
        std::string text = path() + " must be ";
        std::vector<std::string> forms;
        for (const Value& branch : branches.elements) {
            std::string form = formOf(follow(branch));
            if (std::find(forms.begin(), forms.end(), form) == forms.end()) forms.push_back(std::move(form));
        }
        for (std::size_t i = 0; i < forms.size(); ++i)
            text += (i == 0 ? "" : i + 1 == forms.size() ? " or " : ", ") + forms[i];
        report(value.place, "J012", context, text + ", found " + shown(value));
    }

    // The branch a person most likely meant: the right kind, and for objects the same constant members or, failing
    // that, the most keys in common.
    const Value* intended(const Value& branches, const Value& value) const {
        const Value* best = nullptr;
        int bestScore = 0;
        for (const Value& branch : branches.elements) {
            const Value& target = follow(branch);
            const Value* type = target.find("type");
            const Value* words = target.find("enum");
            int score = type && type->isString() && isOfType(value, type->string) ? 1 : 0;
            if (type && type->isString() && type->string == "integer" && value.isNumber()) score = 1;
            if (words && !words->elements.empty() && words->elements[0].kind == value.kind) score = 1;
            if (score == 0) continue;
            if (const Value* properties = target.find("properties")) {
                for (const Member& member : value.members) {
                    const Value* known = properties->find(member.key);
                    const Value* only = known ? known->find("const") : nullptr;
                    score += only ? (equal(*only, member.value) ? 100 : -50) : known ? 1 : 0;
                }
            }
            if (score > bestScore) {
                bestScore = score;
                best = &branch;
            }
        }
        return best;
    }

    const Document& schema_;
    const Patterns& patterns_;
    const Document& document_;
    std::vector<Step> steps_ = {};
    Diagnostics out_ = {};
    int depth_ = 0;
    bool muted_ = false, failed_ = false;
};

}  // namespace

struct Schema::Compiled {
    Document document = {};
    Patterns patterns = {};
};

Result<Schema> Schema::parse(std::string_view text, std::string_view file) {
    Result<Document> document = json::parse(text, file);
    if (!document) return tl::unexpected<Diagnostics>(std::move(document.error()));
    auto compiled = std::make_shared<Compiled>();
    compiled->document = std::move(*document);
    if (Diagnostics faults = checkSchema(compiled->document, compiled->patterns); !faults.empty())
        return tl::unexpected<Diagnostics>(std::move(faults));
    Schema schema;
    schema.compiled_ = std::move(compiled);
    return schema;
}

Diagnostics Schema::validate(const Document& document) const {
    if (!compiled_) return {};
    return Validator(compiled_->document, compiled_->patterns, document).run();
}

}  // namespace pelage::json
