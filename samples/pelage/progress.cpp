// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace pelage::app {

Progress::Progress(std::size_t total) : total_(total), terminal_(isatty(STDOUT_FILENO) == 1) {}

Progress::~Progress() {
    clear();
}

void Progress::clear() {
    if (!terminal_) return;
    std::fputs("\r\x1b[K", stdout);
    std::fflush(stdout);
}

void Progress::show(const std::string& name) {
    if (!terminal_ || total_ == 0) return;
    constexpr std::size_t width = 28;
    const std::size_t filled = finished_ * width / total_;
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::printf("\r\x1b[K[%s] %zu/%zu  %s", bar.c_str(), finished_, total_, name.c_str());
    std::fflush(stdout);
}

void Progress::done(const std::string& line) {
    ++finished_;
    clear();
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

void Progress::skip() {
    ++finished_;
}

}  // namespace pelage::app
