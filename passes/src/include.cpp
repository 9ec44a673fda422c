// SPDX-License-Identifier: MIT
// One tree from several files: each is read and held against the schema by itself, then its members are laid together
// into one root that the reader takes for one file. Places remember which file they are in (description.hpp).
#include "reader.hpp"

#include <algorithm>

namespace pelage::passes {
namespace {

using json::Member;
using json::Value;

constexpr std::size_t mostFiles = 64;

void placeInFile(Value& value, std::size_t file) {
    value.place = inFile(value.place, file);
    for (Value& element : value.elements) placeInFile(element, file);
    for (Member& member : value.members) {
        member.place = inFile(member.place, file);
        placeInFile(member.value, file);
    }
}

std::string besides(const std::string& file, const std::string& name) {
    const std::size_t slash = file.rfind('/');
    const bool absolute = !name.empty() && name.front() == '/';
    return absolute || slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

// A fixed schema, compiled once: a constant like the text it is made of.
const Result<json::Schema>& schema() {
    static const Result<json::Schema> compiled = json::Schema::parse(passTreeSchema(), "passtree.schema.json");
    return compiled;
}

class Includer {
public:
    Includer(const TextReader& reader, const IncludePath& elsewhere, bool disk, Diagnostics& out)
        : reader_(reader), elsewhere_(elsewhere), disk_(disk), out_(out) {}

    Source run(json::Document document, bool onDisk) {
        if (onDisk) source_.onDisk.push_back(document.file);
        take(std::move(document), {});
        return std::move(source_);
    }

private:
    enum class State : std::uint8_t { Open, Done };

    // What a file includes is laid down before the file itself, whose members may name it; apart from that the order
    // does not matter.
    void take(json::Document document, Place from) {
        if (!schema()) return out_.append(schema().error());
        const Diagnostics faults = schema()->validate(document);
        const std::size_t file = source_.files.size();
        source_.files.push_back(document.file);
        states_.push_back(State::Open);
        out_.append(faults);
        // What breaks the schema is not looked at further: one fault, one line.
        if (faults.hasErrors()) return;
        placeInFile(document.root, file);
        if (const Value* included = document.root.find("include")) {
            for (const Value& name : included->elements) include(document.file, name);
        }
        states_[file] = State::Done;
        merge(std::move(document.root), from.line == 0);
    }

    void include(const std::string& from, const Value& name) {
        Reporter reporter(source_.files, out_);
        const std::string path = besides(from, name.string);
        const std::string other = disk_ && elsewhere_ ? elsewhere_(name.string) : path;
        for (std::size_t i = 0; i < source_.files.size(); ++i) {
            if (source_.files[i] != path && source_.files[i] != other) continue;
            if (states_[i] == State::Done) return;  // two files may include a third
            reporter.error(name.place, "P059", "'" + name.string + "' includes itself",
                           i + 1 < source_.files.size() ? "by way of '" + source_.files.back() + "'" : "");
            return;
        }
        if (source_.files.size() == mostFiles) {
            reporter.error(name.place, "P057", "more than " + std::to_string(mostFiles) + " files in one tree");
            return;
        }
        Result<json::Document> document = open(path, other);
        if (document) return take(std::move(*document), name.place);
        const Diagnostic& fault = document.error().items().front();
        if (fault.code != "F001") return out_.append(document.error());
        reporter.error(name.place, "P057", "cannot read the included file '" + path + "'",
                       disk_ || reader_ ? "paths are relative to the file that includes"
                                        : "a tree read from memory needs a reader");
    }

    Result<json::Document> open(const std::string& path, const std::string& other) {
        if (reader_) {
            if (const std::optional<std::string> text = reader_(path)) return json::parse(*text, path);
        } else if (disk_) {
            for (const std::string& each : {path, other}) {
                Result<json::Document> document = json::parseFile(each);
                const bool absent = !document && document.error().items().front().code == "F001";
                if (!absent) source_.onDisk.push_back(each);
                if (!absent) return document;
            }
        }
        Diagnostics none;
        none.add({.code = "F001"});
        return tl::unexpected(std::move(none));
    }

    void merge(Value root, bool own) {
        Value& all = source_.root;
        if (own) all.place = root.place;
        all.kind = json::Kind::Object;
        for (Member& member : root.members) {
            // Of an included file only what is declared counts: not its name and description.
            const bool declares = member.value.isObject() || member.value.isArray();
            if ((!own && !declares) || member.key == "include") continue;
            const auto found = std::find_if(all.members.begin(), all.members.end(),
                                            [&](const Member& each) { return each.key == member.key; });
            if (found == all.members.end()) {
                all.members.push_back(std::move(member));
                continue;
            }
            if (member.key == "drawLists") {
                for (Value& list : member.value.elements) addOnce(found->value, std::move(list));
                continue;
            }
            // Passes of one name are found like those of one file (P002).
            for (Value& element : member.value.elements) found->value.elements.push_back(std::move(element));
            for (Member& each : member.value.members) addOnce(*found, std::move(each));
        }
    }

    void addOnce(Member& group, Member added) {
        for (const Member& each : group.value.members) {
            if (each.key == added.key) return twice(added.key, group.key, added.place, each.place);
        }
        group.value.members.push_back(std::move(added));
    }
    void addOnce(Value& lists, Value added) {
        for (const Value& each : lists.elements) {
            if (each.string == added.string) return twice(added.string, "drawLists", added.place, each.place);
        }
        lists.elements.push_back(std::move(added));
    }
    void twice(const std::string& name, const std::string& group, Place place, Place first) {
        Reporter reporter(source_.files, out_);
        reporter.error(place, "P058", "'" + name + "' of " + group + " is declared in two files",
                       "first at " + source_.files[fileOf(first)] + ":" + std::to_string(lineOf(first)) + ":" +
                           std::to_string(first.column));
    }

    const TextReader& reader_;
    const IncludePath& elsewhere_;
    bool disk_;
    Diagnostics& out_;
    Source source_ = {};
    std::vector<State> states_ = {};
};

}  // namespace

Source readSource(json::Document document, const TextReader& reader, const IncludePath& elsewhere, bool disk,
                  Diagnostics& out) {
    Source source = Includer(reader, elsewhere, disk, out).run(std::move(document), disk);
    if (out.hasErrors()) return source;
    // A file that is included need not be a whole frame; the whole must be.
    Reporter reporter(source.files, out);
    for (const std::string_view key : {"name", "passes", "exports"}) {
        const Value* found = source.root.find(key);
        const bool empty = found && !found->isString() && found->elements.empty() && found->members.empty();
        if (found && !empty) continue;
        reporter.error(found ? found->place : source.root.place, "J011",
                       "the document has no \"" + std::string(key) + "\"");
    }
    return source;
}

}  // namespace pelage::passes
