// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <set>

namespace pelage::passes {
namespace {

using Root = Reference::Root;

class ReferenceChecker {
public:
    ReferenceChecker(PassTree::Description& description, Reporter& reporter)
        : tree_(description), reporter_(reporter) {}

    void run() {
        for (const PassDeclaration& pass : tree_.passes) {
            for (const SlotDeclaration& slot : pass.slots) {
                const std::size_t before = reporter_.errors();
                for (std::size_t i = 0; i < slot.connect.size(); ++i) connection(pass, slot, i);
                standIn(pass, slot);
                if (reporter_.errors() == before) alwaysFed(pass, slot);
            }
        }
        for (const ExportDeclaration& each : tree_.exports) exported(each);
    }

private:
    // The pass's declaration and slot that a `Pass.slot` means; reports P016. A pass that the file lacks is a warning
    // when the reader names something else to take instead: that is how a tree survives the removal of a pass.
    const SlotDeclaration* result(const Reference& reference, bool replaceable, const std::string& instead) {
        const PassDeclaration* pass = tree_.pass(reference.owner);
        if (!pass) {
            const std::string hint =
                didYouMean(reference.owner, namesOf(tree_.passes),
                           R"(restore the pass, or name what to take instead: ["Pass.slot", "other"])");
            if (replaceable) {
                reporter_.warning(reference.place, "P049", "unknown pass '" + reference.owner + "'; " + instead,
                                  didYouMean(reference.owner, namesOf(tree_.passes)));
            } else {
                reporter_.error(reference.place, "P016", "unknown pass '" + reference.owner + "'", hint);
            }
            return nullptr;
        }
        const SlotDeclaration* slot = pass->slot(reference.member);
        if (!slot) {
            reporter_.error(reference.place, "P016", "pass '" + pass->name + "' has no slot '" + reference.member + "'",
                            didYouMean(reference.member, pass->slotNames()));
            return nullptr;
        }
        if (slot->access == SlotAccess::Read) {
            reporter_.error(reference.place, "P036",
                            "'" + reference.text() + "' only reads; it has no result to connect to",
                            producerHint(*slot));
            return nullptr;
        }
        return slot;
    }

    // What is taken when the reference at `index` names nothing: the next that may exist, or one before it.
    const Reference* otherThan(const std::vector<Reference>& all, std::size_t index, SlotAccess access) const {
        for (std::size_t step = 1; step < all.size(); ++step) {
            const Reference& other = all[(index + step) % all.size()];
            if (feed(other, access) != Feed::Never) return &other;
        }
        return nullptr;
    }

    static std::string producerHint(const SlotDeclaration& slot) {
        return slot.connect.empty() ? std::string{} : "did you mean '" + slot.connect.front().text() + "'?";
    }

    void connection(const PassDeclaration& pass, const SlotDeclaration& slot, std::size_t index) {
        const Reference& reference = slot.connect[index];
        const std::string title = "'" + pass.name + "." + slot.name + "'";
        const bool writes = slot.access != SlotAccess::Read;
        switch (reference.root) {
            case Root::Pass: {
                if (reference.owner == pass.name) {
                    reporter_.error(reference.place, "P035", "pass '" + pass.name + "' is connected to itself");
                    return;
                }
                if (slot.access == SlotAccess::Write) {
                    reporter_.error(reference.place, "P022", title + " writes a new image but is connected to a result",
                                    "connect it to att.* or host.*, or give it access readWrite");
                    return;
                }
                const Reference* other = otherThan(slot.connect, index, slot.access);
                result(reference, other || slot.optional,
                       other ? "'" + other->text() + "' is taken instead" : title + " stays unconnected");
                return;
            }
            case Root::Host:
                return imported(slot, reference, title);
            case Root::Attachment: {
                const AttachmentDeclaration* attachment = tree_.attachment(reference.member);
                if (!attachment) return unknown(reference, "attachment", namesOf(tree_.attachments), "att.");
                kindFits(slot, reference, attachment->isBuffer, title);
                const bool begins =
                    slot.access == SlotAccess::Write || (slot.access == SlotAccess::ReadWrite && slot.hasClear);
                if (!begins) {
                    reporter_.error(reference.place, "P019",
                                    title + " reads '" + reference.text() + "' before anything has written it",
                                    writerHint(reference, pass.name));
                }
                return;
            }
            case Root::History: {
                const AttachmentDeclaration* attachment = tree_.attachment(reference.member);
                if (!attachment) return unknown(reference, "attachment", namesOf(tree_.attachments), "history.");
                if (!attachment->history) {
                    reporter_.error(reference.place, "P060",
                                    title + " reads '" + reference.text() + "', but 'att." + reference.member +
                                        "' keeps no history",
                                    "add \"history\": 1 to it at " + reporter_.at(attachment->place));
                    return;
                }
                if (writes) {
                    reporter_.error(reference.place, "P017",
                                    title + " writes '" + reference.text() + "', which is of the last frame",
                                    "write 'att." + reference.member + "'");
                    return;
                }
                return kindFits(slot, reference, attachment->isBuffer, title);
            }
            case Root::Constant:
                if (!has(constantNames(), reference.member))
                    return unknown(reference, "constant", constantNames(), "const.");
                if (writes)
                    reporter_.error(reference.place, "P017",
                                    title + " writes '" + reference.text() + "', which is constant");
                if (!writes && slot.use != SlotUse::Sampled) {
                    reporter_.error(reference.place, "P045",
                                    "'" + reference.text() + "' can only feed sampled slots, " + title + " is " +
                                        std::string(word(slot.use)));
                }
                return;
        }
    }

    void imported(const SlotDeclaration& slot, const Reference& reference, const std::string& title) {
        const ImportDeclaration* import = tree_.import(reference.member);
        if (!import) return unknown(reference, "import", namesOf(tree_.imports), "host.");
        const auto complain = [&](const std::string& does, const std::string& lends, const std::string& access) {
            reporter_.error(reference.place, "P017",
                            title + " " + does + " '" + reference.text() + "', which the host lends " + lends,
                            "set access of the import at " + reporter_.at(import->place) + " to " + access);
        };
        if (slot.access != SlotAccess::Read && import->access == SlotAccess::Read)
            complain("writes", "read-only", "readWrite");
        if (slot.access != SlotAccess::Write && import->access == SlotAccess::Write)
            complain("reads", "write-only", "readWrite");
        kindFits(slot, reference, import->kind == ImportDeclaration::Kind::Buffer, title);
    }

    void kindFits(const SlotDeclaration& slot, const Reference& reference, bool buffer, const std::string& title) {
        const bool either = slot.use == SlotUse::Storage || slot.use == SlotUse::Copy;
        if (!either && buffer != isBufferUse(slot.use)) {
            reporter_.error(reference.place, "P037",
                            "'" + reference.text() + "' is " + (buffer ? "a buffer" : "an image") + "; " + title +
                                " is " + std::string(word(slot.use)));
        } else if (either && !buffer && slot.clearIsZero) {
            reporter_.error(
                slot.clearPlace, "P037",
                "\"clear\": 0 is for buffers; " + title + " is connected to the image '" + reference.text() + "'",
                "clear it as a color target of another pass");
        }
    }

    void unknown(const Reference& reference, const std::string& what, const std::vector<std::string>& known,
                 const std::string& prefix) {
        std::vector<std::string> full;
        for (const std::string& name : known) full.push_back(prefix + name);
        reporter_.error(reference.place, "P016", "unknown " + what + " '" + reference.text() + "'",
                        didYouMean(reference.text(), full));
    }

    std::string writerHint(const Reference& attachment, const std::string& reader) const {
        for (const PassDeclaration& pass : tree_.passes) {
            for (const SlotDeclaration& slot : pass.slots) {
                if (pass.name == reader || slot.access != SlotAccess::Write) continue;
                for (const Reference& each : slot.connect) {
                    if (each.text() == attachment.text()) return "did you mean '" + pass.name + "." + slot.name + "'?";
                }
            }
        }
        return "connect it to the slot of the pass that writes it";
    }

    void standIn(const PassDeclaration& pass, const SlotDeclaration& slot) {
        if (!slot.whenDisabled) return;
        const Reference& stand = *slot.whenDisabled;
        const std::string title = std::string(word(slot.use)) + " slot '" + pass.name + "." + slot.name + "'";
        if (slot.access == SlotAccess::Read) {
            reporter_.error(stand.place, "P045", title + " only reads; nobody needs a stand-in for it", "remove it");
        } else if (stand.root != Root::Constant) {
            reporter_.error(stand.place, "P045", "'" + stand.text() + "' cannot stand in for " + title,
                            "a stand-in is const.*; a reader can name other results itself");
        } else if (!has(constantNames(), stand.member)) {
            unknown(stand, "constant", constantNames(), "const.");
        } else if (isDepthConstant(stand.member) != (slot.use == SlotUse::Depth)) {
            reporter_.error(stand.place, "P045", "'" + stand.text() + "' cannot stand in for " + title);
        }
    }

    enum class Feed { Always, Sometimes, Never };
    Feed feed(const Reference& reference, SlotAccess access) const {
        switch (reference.root) {
            case Root::Pass: {
                const PassDeclaration* pass = tree_.pass(reference.owner);
                if (!pass) return Feed::Never;
                const SlotDeclaration* slot = pass->slot(reference.member);
                const bool stands = slot && slot->whenDisabled && access == SlotAccess::Read;
                return stands || !tree_.canBeDisabled(*pass) ? Feed::Always : Feed::Sometimes;
            }
            case Root::Host: {
                const ImportDeclaration* import = tree_.import(reference.member);
                return import && !import->optional ? Feed::Always : Feed::Sometimes;
            }
            case Root::Attachment:
            case Root::History:
            case Root::Constant:
                return Feed::Always;
        }
        return Feed::Never;
    }

    // No setting may leave a needed slot without a source. A pass with a condition of its own is looked at when the
    // tree is compiled, for then it may be off together with its source.
    void alwaysFed(const PassDeclaration& pass, const SlotDeclaration& slot) {
        if (slot.optional || slot.connect.empty() || !pass.enabled || pass.enabledWhen) return;
        for (const Reference& reference : slot.connect) {
            if (feed(reference, slot.access) == Feed::Always) return;
        }
        const Reference& last = slot.connect.back();
        const std::string title = pass.name + "." + slot.name;
        if (last.root == Root::Host) {
            reporter_.error(last.place, "P018",
                            "'" + last.text() + "' may be absent, but slot '" + title + "' is required",
                            "mark the slot optional, or \"enabledWhen\": \"host.has('" + last.member + "')\"");
            return;
        }
        const bool canStand = slot.access == SlotAccess::Read;
        reporter_.error(
            last.place, "P044", "'" + title + "' needs '" + last.text() + "', but '" + last.owner + "' can be disabled",
            (canStand ? "give '" + last.owner + "' a \"whenDisabled\" for '" + last.member + "', " : std::string{}) +
                "name another source after it, or mark '" + title + "' optional");
    }

    void exported(const ExportDeclaration& each) {
        bool fed = false, faulty = false;
        for (std::size_t i = 0; i < each.from.size(); ++i) {
            const Reference& reference = each.from[i];
            if (reference.root != Root::Pass) {
                reporter_.error(
                    reference.place, "P036",
                    "export '" + each.name + "' must come from a pass, not from '" + reference.text() + "'");
                faulty = true;
                continue;
            }
            const Reference* other = otherThan(each.from, i, SlotAccess::ReadWrite);
            const std::size_t before = reporter_.errors();
            const SlotDeclaration* slot = result(
                reference, other || each.optional,
                other ? "'" + other->text() + "' is exported instead" : "export '" + each.name + "' stays empty");
            if (reporter_.errors() != before) faulty = true;
            if (slot && feed(reference, SlotAccess::ReadWrite) == Feed::Always) fed = true;
        }
        if (fed || faulty || each.optional || each.from.empty()) return;
        const Reference& last = each.from.back();
        reporter_.error(
            last.place, "P044",
            "export '" + each.name + "' needs '" + last.text() + "', but '" + last.owner + "' can be disabled",
            "name another source after it, or mark the export optional");
    }

    PassTree::Description& tree_;
    Reporter& reporter_;
};

}  // namespace

void checkReferences(PassTree::Description& description, Reporter& reporter) {
    ReferenceChecker(description, reporter).run();
}

void warnUnused(PassTree::Description& tree, Reporter& reporter) {
    std::set<std::string> used;
    const auto value = [&](const NumberOrSetting& number) { used.insert("setting " + number.setting); };
    const auto condition = [&](const std::optional<Expression>& expression) {
        if (!expression) return;
        for (const std::string& name : expression->settings()) used.insert("setting " + name);
        for (const ImportDeclaration& import : tree.imports) {
            if (expression->text().find("'" + import.name + "'") != std::string::npos)
                used.insert("host." + import.name);
        }
    };
    for (const PassDeclaration& pass : tree.passes) {
        used.insert("list " + pass.drawList);
        used.insert("view " + pass.view);
        condition(pass.enabledWhen);
        condition(pass.shader.when);
        for (const ConstantDeclaration& constant : pass.constants) value(constant.value);
        for (const ParameterDeclaration& parameter : pass.parameters) value(parameter.value);
        for (const SlotDeclaration& slot : pass.slots) {
            for (const Reference& reference : slot.connect) used.insert(reference.text());
        }
    }
    for (const ViewDeclaration& view : tree.views) value(view.count);
    for (const AttachmentDeclaration& attachment : tree.attachments) {
        used.insert("view " + attachment.layersView);
        used.insert(attachment.size.like);
        used.insert(attachment.bytes.pixels.like);
        value(attachment.bytes.count);
        value(attachment.samples);
        value(attachment.size.width);
        value(attachment.size.height);
        value(attachment.mipLevels);
        if (attachment.size.depth) value(*attachment.size.depth);
    }
    const auto warn = [&](const std::string& key, const std::string& what, Place place) {
        if (!used.count(key)) reporter.warning(place, "P047", what + " is never used", "use it or remove it");
    };
    for (const AttachmentDeclaration& each : tree.attachments)
        warn("att." + each.name, "attachment '" + each.name + "'", each.place);
    for (const AttachmentDeclaration& each : tree.attachments) {
        if (each.history) warn("history." + each.name, "the history of attachment '" + each.name + "'", each.place);
    }
    for (const ImportDeclaration& each : tree.imports)
        warn("host." + each.name, "import '" + each.name + "'", each.place);
    for (const DrawListDeclaration& each : tree.drawLists)
        warn("list " + each.name, "draw list '" + each.name + "'", each.place);
    for (const ViewDeclaration& each : tree.views) warn("view " + each.name, "view '" + each.name + "'", each.place);
    for (const SettingDeclaration& each : tree.settings) {
        warn("setting " + each.info.name, "setting '" + each.info.name + "'", each.place);
    }
}

}  // namespace pelage::passes
