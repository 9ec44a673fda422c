// SPDX-License-Identifier: MIT
#include "source.hpp"

#include "reading.hpp"

#include <pelage/hair/load.hpp>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace pelage::hair {
namespace reading {
namespace {

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.find_last_of("/\\");
    return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}

tl::unexpected<Diagnostics> tooLarge(const std::string& path, std::uint64_t limit) {
    return fault("F002", path, "the file is larger than the limit of " + std::to_string(limit) + " bytes",
                 "split the asset, or remove what hair does not need from it");
}

tl::unexpected<Diagnostics> emptyFile(const std::string& path) {
    return fault("F003", path, "the file is empty (0 bytes)", "export or download it again");
}

}  // namespace

Result<Source> Source::open(const std::string& path, std::uint64_t limit) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        return fault("F001", path, "there is no such file", "check the spelling and the folder the program runs in");
    }
    if (std::filesystem::is_directory(path, error)) {
        return fault("F001", path, "this is a folder, expected a file", "name a file inside it");
    }
    Source source;
    source.folder_ = folderOf(path);
    source.file_.reset(std::fopen(path.c_str(), "rb"));
    if (!source.file_) {
        const std::string why = std::error_code(errno, std::generic_category()).message();
        return fault("F001", path, "the file cannot be opened: " + why, "check its permissions");
    }
    // Every part is read once and to its place: a buffer in between would be one more copy.
    std::setvbuf(source.file_.get(), nullptr, _IONBF, 0);
    if (std::filesystem::is_regular_file(path, error)) {
        source.size_ = std::filesystem::file_size(path, error);
        if (error) return cannotRead(path);
        if (source.size_ > limit) return tooLarge(path, limit);
        if (source.size_ == 0) return emptyFile(path);
        return source;
    }
    // Pipes have no size.
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    for (std::size_t got = kBlock; got == kBlock;) {
        const std::size_t used = source.owned_.size();
        source.owned_.resize(used + kBlock);
        got = std::fread(source.owned_.data() + used, 1, kBlock, source.file_.get());
        source.owned_.resize(used + got);
        if (source.owned_.size() > limit) return tooLarge(path, limit);
    }
    if (std::ferror(source.file_.get()) != 0) return cannotRead(path);
    if (source.owned_.empty()) return emptyFile(path);
    source.file_.reset();
    source.bytes_ = source.owned_;
    source.size_ = source.owned_.size();
    return source;
}

bool Source::read(std::uint64_t offset, std::span<std::byte> to) {
    if (!fits(offset, to.size(), 1, size_)) return false;
    if (to.empty()) return true;
    if (!file_) {
        std::memcpy(to.data(), bytes_.data() + offset, to.size());
        return true;
    }
    if (std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET) != 0) return false;
    return std::fread(to.data(), 1, to.size(), file_.get()) == to.size();
}

std::span<const std::byte> Source::all() {
    if (file_) {
        owned_.resize(size_);
        if (!read(0, owned_)) owned_.clear();
        file_.reset();
        bytes_ = owned_;
    }
    return bytes_;
}

}  // namespace reading

Result<std::vector<std::byte>> readFile(const std::string& path, std::size_t limit) {
    auto source = reading::Source::open(path, limit);
    if (!source) return tl::unexpected(source.error());
    std::vector<std::byte> bytes(source->size());
    if (!source->read(0, bytes)) return reading::cannotRead(path);
    return bytes;
}

}  // namespace pelage::hair
