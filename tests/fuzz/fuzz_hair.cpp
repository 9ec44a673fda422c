// SPDX-License-Identifier: MIT
// libFuzzer entry point of parseHair: no input may crash, leak or take memory out of proportion.
#include <pelage/hair/load.hpp>

#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    (void)pelage::hair::parseHair(std::as_bytes(std::span(data, size)), "fuzz");
    return 0;
}
