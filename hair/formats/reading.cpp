// SPDX-License-Identifier: MIT
#include "reading.hpp"

#include <pelage/hair/load.hpp>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pelage::hair {
namespace reading {

std::string oneLine(std::string_view text, std::size_t limit) {
    std::string line;
    for (const char c : text) {
        const bool blank = static_cast<unsigned char>(c) <= 0x20 || c == 0x7F;
        if (blank && (line.empty() || line.back() == ' ')) continue;
        line += blank ? ' ' : c;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.size() > limit) {
        line.resize(limit);
        line += "...";
    }
    return line;
}

Diagnostic remark(Severity severity, std::string_view code, std::string_view file, std::string_view text,
                  std::string_view hint) {
    Diagnostic d;
    d.severity = severity;
    d.code = code;
    d.file = file;
    d.text = oneLine(text, 600);
    d.hint = oneLine(hint, 600);
    return d;
}

Diagnostic fault(std::string_view code, std::string_view file, std::string_view text, std::string_view hint) {
    return remark(Severity::Error, code, file, text, hint);
}

}  // namespace reading

Result<std::vector<std::byte>> readFile(const std::string& path, std::size_t limit) {
    using reading::fault;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        return tl::unexpected(
            fault("F001", path, "there is no such file", "check the spelling and the folder the program runs in"));
    }
    if (std::filesystem::is_directory(path, error)) {
        return tl::unexpected(fault("F001", path, "this is a folder, expected a file", "name a file inside it"));
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        const std::string why = std::error_code(errno, std::generic_category()).message();
        return tl::unexpected(fault("F001", path, "the file cannot be opened: " + why, "check its permissions"));
    }
    // Read in blocks instead of trusting a size asked for beforehand: pipes have none and files may grow.
    std::vector<std::byte> bytes;
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    while (stream) {
        const std::size_t used = bytes.size();
        bytes.resize(used + kBlock);
        stream.read(reinterpret_cast<char*>(bytes.data() + used), static_cast<std::streamsize>(kBlock));
        bytes.resize(used + static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > limit) {
            return tl::unexpected(fault("F002", path,
                                        "the file is larger than the limit of " + std::to_string(limit) + " bytes",
                                        "split the asset, or remove what hair does not need from it"));
        }
    }
    if (stream.bad()) return tl::unexpected(fault("F001", path, "reading the file failed half way", "try again"));
    if (bytes.empty()) {
        return tl::unexpected(fault("F003", path, "the file is empty (0 bytes)", "export or download it again"));
    }
    return bytes;
}

}  // namespace pelage::hair
