// SPDX-License-Identifier: MIT
#include "text_file.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace pelage::app {

namespace fs = std::filesystem;

namespace {

Failure notWritten(const std::string& path, const std::string& why) {
    return Failure("A094: " + path + ": the file cannot be written: " + why);
}

Result<void> writeOut(const std::string& text) {
    const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!whole) return tl::unexpected(Failure("A094: standard output takes no more; was the pipe closed?"));
    return {};
}

}  // namespace

Result<std::string> readTextFile(const std::string& path) {
    if (path == "-") return std::string(std::istreambuf_iterator<char>(std::cin), {});
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        return tl::unexpected(Failure("A090: " + path + " is a directory; expected a file, or - for standard input"));
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) return tl::unexpected(Failure("A090: " + path + ": the file cannot be opened; check the path"));
    std::string text(std::istreambuf_iterator<char>(file), {});
    if (file.bad()) return tl::unexpected(Failure("A090: " + path + ": the file cannot be read to its end"));
    return text;
}

Result<void> writeTextFile(const std::string& path, const std::string& text) {
    if (path == "-") return writeOut(text);
    std::error_code unknown;
    if (fs::exists(path, unknown) && !fs::is_regular_file(path, unknown)) {
        // A device or a pipe is written to; renaming a file over it would replace it.
        if (fs::is_directory(path, unknown)) return tl::unexpected(notWritten(path, "it is a directory"));
        std::ofstream special(path, std::ios::binary);
        special.write(text.data(), static_cast<std::streamsize>(text.size()));
        special.close();
        if (!special) return tl::unexpected(notWritten(path, "it takes no more"));
        return {};
    }
    const std::string partial = path + ".part";
    std::ofstream file(partial, std::ios::binary | std::ios::trunc);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    std::error_code failed, ignored;
    if (file) fs::rename(partial, path, failed);
    if (!file || failed) {
        fs::remove(partial, ignored);
        return tl::unexpected(notWritten(path, failed ? failed.message() : "no such directory, or no room or right"));
    }
    return {};
}

}  // namespace pelage::app
