// SPDX-License-Identifier: MIT
// Numbers for names, once for all when a tree has been found without fault: the linker then compares no words.
#include "reader.hpp"

#include <unordered_map>

namespace pelage::passes {
namespace {

template <class T>
std::unordered_map<std::string_view, std::uint32_t> numbersOf(const std::vector<T>& items) {
    std::unordered_map<std::string_view, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < items.size(); ++i) numbers.emplace(items[i].name, i);
    return numbers;
}

}  // namespace

void resolveNames(PassTree::Description& tree) {
    const auto passes = numbersOf(tree.passes);
    const auto imports = numbersOf(tree.imports);
    const auto attachments = numbersOf(tree.attachments);
    const auto views = numbersOf(tree.views);
    const auto find = [](const auto& numbers, std::string_view name) {
        const auto found = numbers.find(name);
        return found == numbers.end() ? none : found->second;
    };
    const auto resolve = [&](Reference& reference) {
        using Root = Reference::Root;
        switch (reference.root) {
            case Root::Pass: {
                reference.index = find(passes, reference.owner);
                if (reference.index == none) return;
                const auto& slots = tree.passes[reference.index].slots;
                for (std::uint32_t i = 0; i < slots.size(); ++i) {
                    if (slots[i].name == reference.member) reference.slot = i;
                }
                return;
            }
            case Root::Host:
                reference.index = find(imports, reference.member);
                return;
            case Root::Attachment:
            case Root::History:
                reference.index = find(attachments, reference.member);
                return;
            case Root::Constant:
                for (std::uint32_t i = 0; i < constantNames().size(); ++i) {
                    if (constantNames()[i] == reference.member) reference.index = i;
                }
                return;
        }
    };
    const auto like = [&](SizeDeclaration& size) {
        const std::string_view text = size.like;
        if (text.starts_with("host.")) size.likeIndex = find(imports, text.substr(5));
        if (text.starts_with("att.")) size.likeIndex = find(attachments, text.substr(4));
    };
    for (PassDeclaration& pass : tree.passes) {
        pass.viewIndex = find(views, pass.view);
        for (SlotDeclaration& slot : pass.slots) {
            for (Reference& reference : slot.connect) resolve(reference);
            if (slot.whenDisabled) resolve(*slot.whenDisabled);
        }
        for (OrderedAfter& after : pass.after) after.index = find(passes, after.pass);
    }
    for (ExportDeclaration& each : tree.exports) {
        for (Reference& reference : each.from) resolve(reference);
    }
    for (AttachmentDeclaration& attachment : tree.attachments) {
        attachment.viewIndex = find(views, attachment.layersView);
        like(attachment.size);
        like(attachment.bytes.pixels);
    }
}

}  // namespace pelage::passes
