// SPDX-License-Identifier: MIT
// Where a reader takes its bytes from: memory, or a file of which each part is read straight to where it belongs.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pelage::hair::reading {

class Source {
public:
    /// The bytes must stay where they are while the source lives.
    explicit Source(std::span<const std::byte> bytes) : bytes_(bytes), size_(bytes.size()) {}
    /// F001 cannot open, F002 larger than `limit`, F003 empty. What has no size (a pipe) is read whole.
    static Result<Source> open(const std::string& path, std::uint64_t limit = std::uint64_t{1} << 31);

    std::uint64_t size() const { return size_; }
    /// Where the file lies, for files that it names; empty for memory, which must be complete in itself.
    const std::string& folder() const { return folder_; }
    /// Fills `to` with the bytes from `offset` on. False when they are not there, or cannot be read.
    bool read(std::uint64_t offset, std::span<std::byte> to);
    template <class T>
    bool read(std::uint64_t offset, std::vector<T>& to) {
        return read(offset, std::as_writable_bytes(std::span(to)));
    }
    /// Everything, in memory for as long as the source lives; empty when the file cannot be read.
    std::span<const std::byte> all();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    Source() = default;

    std::span<const std::byte> bytes_ = {};
    std::vector<std::byte> owned_ = {};
    std::unique_ptr<std::FILE, Close> file_ = {};
    std::string folder_ = {};
    std::uint64_t size_ = 0;
};

}  // namespace pelage::hair::reading
