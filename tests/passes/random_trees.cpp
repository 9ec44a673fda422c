// SPDX-License-Identifier: MIT
#include "random_trees.hpp"

namespace pelage::passes::test {
namespace {

std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
    std::uint64_t x = a * 0x9E3779B97F4A7C15ULL ^ (b + 0xD1B54A32D192ED03ULL);
    x ^= x >> 29;
    x *= 0xBF58476D1CE4E5B9ULL;
    return x ^ (x >> 32);
}
std::uint64_t mix(std::uint64_t a, std::string_view text) {
    for (const char c : text) a = mix(a, static_cast<unsigned char>(c));
    return a;
}

class TreeWriter {
public:
    explicit TreeWriter(std::uint32_t seed) : random_(seed) {}

    std::string write() {
        const std::uint32_t count = 4 + below(22);
        for (std::uint32_t i = 0; i < count; ++i) pass(i);
        std::string exports;
        for (const Result& result : results_) {
            // Also what a later pass changes: an export of the middle of a chain shows its end.
            if (below(5) == 0 || &result == &results_.back())
                exports += std::string(exports.empty() ? "" : ", ") + "\"E" + result.pass + result.slot +
                           R"(": { "from": ")" + result.pass + "." + result.slot + R"(", "optional": true })";
        }
        return R"({ "format": "pelage.passtree/1", "name": "Random", "settings": {
            "a": { "type": "bool", "default": true }, "b": { "type": "bool", "default": false } },
            "imports": { "In": { "kind": "image", "access": "readWrite" } },
            "views": { "main": { "count": 1 } }, "drawLists": ["all"], "attachments": {)" +
               attachments_ + "}, \"passes\": [" + passes_ + "], \"exports\": {" + exports + "} }";
    }

private:
    struct Result {
        std::string pass, slot, image;
        bool changed = false;
        int level = -1;  // of an image with several: the one this pass has written
    };

    std::uint32_t below(std::uint32_t limit) {
        return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(random_);
    }

    std::string attachment(bool history, bool pyramid = false) {
        const std::string name = "A" + std::to_string(images_++);
        attachments_ += (attachments_.empty() ? "\"" : ", \"") + name +
                        R"(": { "format": "RGBA8Unorm", "size": { "frame": 1 })" +
                        (pyramid ? R"(, "mipLevels": "full")" : "") + (history ? R"(, "history": 1 })" : " }");
        if (history) histories_.push_back(name);
        return name;
    }

    void slot(std::string& slots, std::string& connect, const std::string& name, const std::string& says,
              const std::string& to) {
        slots += (slots.empty() ? "\"" : ", \"") + name + "\": { " + says + " }";
        connect += (connect.empty() ? "\"" : ", \"") + name + "\": " + to;
    }

    void pass(std::uint32_t index) {
        const std::string name = "P" + std::to_string(index);
        const std::uint32_t kind = below(3);
        std::string slots, connect;
        std::vector<std::string> used;
        const auto use = [&](const std::string& image) {
            const bool fresh = std::find(used.begin(), used.end(), image) == used.end();
            used.push_back(image);
            return fresh;
        };
        std::vector<Result> made;
        const std::string target = kind == 1 ? R"("as": "storage", "bind": "o)" : R"("as": "color")";
        for (std::uint32_t i = 0; i <= below(2); ++i) {
            const std::string out = "out" + std::to_string(i);
            const std::string as = target + (kind == 1 ? std::to_string(i) + "\"" : "");
            const std::string clear = R"(, "clear": [0.5, 0, 0, )" + std::to_string(index) + "]";
            Result* before = results_.empty() ? nullptr : &results_[below(static_cast<std::uint32_t>(results_.size()))];
            // A result that comes from elsewhere when its pass is off cannot be told apart by its name alone.
            // A level that is made from the one before it is a target of another size: it stands alone.
            const bool step = before && before->level >= 0 && before->level < 4;
            if (before && below(3) == 0 && !before->changed && kind != 1 && (!step || i == 0) && use(before->image)) {
                before->changed = true;
                const std::string own = attachment(false, step), from = before->pass + "." + before->slot;
                use(own);
                const int level = step ? before->level + 1 : before->level;
                const std::string says = level < 0 ? "" : R"(, "level": )" + std::to_string(level);
                slot(slots, connect, out, R"("access": "readWrite", )" + as + clear + says,
                     "[\"" + from + "\", \"att." + own + "\"]");
                made.push_back({name, out, before->image, false, level});
                if (!step) continue;
                slot(slots, connect, "below",
                     R"("access": "read", "as": "sampled", "bind": "below", "optional": true, "level": )" +
                         std::to_string(before->level),
                     "\"" + from + "\"");
                break;
            }
            const bool pyramid = below(3) == 0;
            const std::string image = attachment(!pyramid && below(5) == 0, pyramid);
            use(image);
            const std::string begins = kind == 0 ? clear : "";  // fullscreen and compute cover what they write
            slot(slots, connect, out, R"("access": "write", )" + as + begins, "\"att." + image + "\"");
            made.push_back({name, out, image, false, pyramid ? 0 : -1});
        }
        for (std::uint32_t i = 0; i < below(4); ++i) {
            const std::string in = "in" + std::to_string(i);
            const std::string says = R"("access": "read", "as": "sampled", "bind": "i)" + std::to_string(i) + "\"";
            if (!histories_.empty() && below(5) == 0) {
                const std::string& last = histories_[below(static_cast<std::uint32_t>(histories_.size()))];
                slot(slots, connect, in, says, "\"history." + last + "\"");
                continue;
            }
            if (results_.empty() || below(8) == 0) {
                slot(slots, connect, in, says, below(2) ? "\"host.In\"" : "\"const.white\"");
                continue;
            }
            const Result& a = results_[below(static_cast<std::uint32_t>(results_.size()))];
            const Result& b = results_[below(static_cast<std::uint32_t>(results_.size()))];
            if (!use(a.image) || !use(b.image)) continue;
            const std::string first = "\"" + a.pass + "." + a.slot + "\"";
            // Another image of a list may not have that level.
            if (a.level >= 0) {
                slot(slots, connect, in, says + R"(, "optional": true, "level": )" + std::to_string(a.level), first);
            } else if (b.level >= 0 || below(3) == 0) {
                slot(slots, connect, in, says + R"(, "optional": true)", first);
            } else {
                slot(slots, connect, in, says, "[" + first + ", \"" + b.pass + "." + b.slot + "\", \"const.white\"]");
            }
        }
        std::string text = R"({ "name": ")" + name + "\", ";
        text += kind == 0   ? R"("kind": "raster", "view": "main", "drawList": "all")"
                : kind == 1 ? R"("kind": "compute", "shader": "x.comp")"
                            : R"("kind": "fullscreen", "shader": "x.frag")";
        if (below(7) == 0) text += below(2) ? R"(, "enabledWhen": "a && b")" : R"(, "enabled": false)";
        if (below(9) == 0) text += R"(, "sideEffects": true)";
        if (index > 0 && below(6) == 0) text += R"(, "after": ["P)" + std::to_string(below(index)) + "\"]";
        text += ", \"slots\": {" + slots + "}, \"connect\": {" + connect + "} }";
        passes_ += (passes_.empty() ? "" : ",\n") + text;
        for (Result& each : made) results_.push_back(std::move(each));
    }

    std::mt19937 random_;
    std::vector<Result> results_;
    std::vector<std::string> histories_;
    std::string attachments_, passes_;
    int images_ = 0;
};

class Machine {
public:
    Machine(const Plan& plan, std::uint64_t rubbish) : plan_(plan), rubbish_(rubbish), heap_(plan.heapBytes) {
        own_.resize(plan.resources.size());
        for (std::size_t i = 0; i < plan.resources.size(); ++i) {
            const PlanResource& image = plan.resources[i];
            if (image.heapOffset == notPlaced) own_[i].resize(4);
            // What the host lends, constants, and what a history shows in the first frame have contents.
            fill(i, image.kind == PlanResource::Kind::Transient ? spoil() : mix(1, image.name));
        }
    }

    Trace run() {
        for (frame_ = 0; frame_ < 3 && run_.fault.empty(); ++frame_) frame();
        return std::move(run_);
    }

private:
    std::uint64_t spoil() { return rubbish_ = mix(rubbish_, 77); }
    std::span<std::uint64_t> cells(std::size_t resource) {
        const PlanResource& image = plan_.resources[resource];
        if (image.heapOffset == notPlaced) return own_[resource];
        return std::span(heap_).subspan(image.heapOffset, image.heapBytes);
    }
    void fill(std::size_t resource, std::uint64_t with) {
        std::uint64_t number = 0;
        for (std::uint64_t& cell : cells(resource)) cell = mix(with, ++number);
    }
    // All of an image, or nothing that a pass made.
    bool holds(std::size_t resource, std::uint64_t value) {
        std::uint64_t number = 0;
        for (const std::uint64_t cell : cells(resource)) {
            if (cell != mix(value, ++number)) return false;
        }
        return true;
    }

    void frame() {
        made_.clear();
        for (std::size_t i = 0; i < plan_.resources.size(); ++i) {
            const PlanResource& image = plan_.resources[i];
            // Of what is not kept nothing is left; what is kept has been made before this frame.
            if (image.kind == PlanResource::Kind::Transient) {
                fill(i, spoil());
            } else if (image.kind == PlanResource::Kind::History) {
                const auto last = last_.find(image.name);
                const std::uint64_t value = last == last_.end() ? mix(1, image.name) : last->second;
                fill(i, value);
                made_[{i, 0}] = value;
            } else {
                fill(i, made_[{i, 0}] = mix(1, image.name));
            }
        }
        for (const PlanPass& pass : plan_.passes) execute(pass);
        for (const auto& [name, resource] : plan_.exports) {
            std::uint64_t sum = 0;
            for (const std::uint64_t cell : cells(resource)) sum = mix(sum, cell);
            run_.exports[std::to_string(frame_) + " " + name] = sum;
            if (!holds(resource, newest(resource))) run_.fault = "export " + name + " has been overwritten";
        }
        for (const PlanResource& image : plan_.resources) {
            if (image.kind != PlanResource::Kind::History || image.partner == none) continue;
            last_[image.name] = newest(image.partner);
            if (!holds(image.partner, newest(image.partner))) run_.fault = image.name + " was not kept";
        }
    }

    std::uint64_t newest(std::size_t resource) {
        std::uint64_t value = 0;
        for (const auto& [key, made] : made_) {
            if (key.first == resource) value = made;
        }
        return value;
    }

    void execute(const PlanPass& pass) {
        std::uint64_t found = mix(3, pass.name);
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource == none || slot.reads == none) continue;
            const auto made = made_.find({slot.resource, slot.reads});
            if (made == made_.end() || !holds(slot.resource, made->second)) {
                run_.fault = pass.name + "." + slot.name + " does not find version " + std::to_string(slot.reads) +
                             " of " + plan_.resources[slot.resource].name;
                return;
            }
            found = mix(mix(found, slot.name), made->second);
        }
        run_.found[std::to_string(frame_) + " " + pass.name] = found;
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource == none || slot.makes == none) continue;
            const std::uint64_t left = mix(mix(found, slot.name), slot.load == rhi::LoadOp::Clear ? 5U : 7U);
            fill(slot.resource, slot.store == rhi::StoreOp::Store ? left : spoil());
            made_[{slot.resource, slot.makes}] = left;
        }
    }

    const Plan& plan_;
    std::uint64_t rubbish_;
    std::vector<std::uint64_t> heap_;
    std::vector<std::vector<std::uint64_t>> own_;
    std::map<std::pair<std::size_t, std::uint32_t>, std::uint64_t> made_;  // by resource and version
    std::map<std::string, std::uint64_t> last_;
    int frame_ = 0;
    Trace run_;
};

}  // namespace

std::string randomTree(std::uint32_t seed) {
    return TreeWriter(seed).write();
}

HostDescription randomHost() {
    HostDescription host{.extent = {16, 16, 1}};
    host.imports["In"] = {true, rhi::TextureFormat::RGBA8Unorm, {16, 16, 1}, 1};
    host.memory = [](const PlanResource& image) {
        const std::uint64_t number = mix(11, image.name);
        return MemoryNeed{1 + number % 40, 1ULL << (number / 64 % 4)};
    };
    return host;
}

std::string chainTree(int count) {
    std::string attachments, passes, before = "host.In";
    for (int i = 0; i < count; ++i) {
        const std::string n = std::to_string(i);
        attachments += (i ? ", \"A" : "\"A") + n + R"(": { "format": "RGBA8Unorm", "size": { "frame": 1 } })";
        passes += std::string(i ? ",\n" : "") + R"({ "name": "P)" + n +
                  R"(", "kind": "fullscreen", "shader": "x.frag", "slots": {
            "in": { "access": "read", "as": "sampled", "bind": "u_in" },
            "also": { "access": "read", "as": "sampled", "bind": "u_also" },
            "out": { "access": "write", "as": "color" } }, "connect": { "in": ")" +
                  before + R"(", "also": ")" + (i > 1 ? "P" + std::to_string(i - 2) + ".out" : "host.In") +
                  R"(", "out": "att.A)" + n + "\" } }";
        before = "P" + n + ".out";
    }
    return R"({ "format": "pelage.passtree/1", "name": "Chain",
        "imports": { "In": { "kind": "image", "access": "read" } }, "attachments": {)" +
           attachments + "}, \"passes\": [" + passes + R"(], "exports": { "Out": { "from": ")" + before + "\" } } }";
}

HostDescription chainTreeHost() {
    HostDescription host = randomHost();
    host.memory = {};
    return host;
}

Trace runPlan(const Plan& plan, std::uint64_t rubbish) {
    return Machine(plan, rubbish).run();
}

}  // namespace pelage::passes::test
