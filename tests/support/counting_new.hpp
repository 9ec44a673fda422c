// SPDX-License-Identifier: MIT
// Counts what a test program asks of the heap. To be included by one source file of a program, because it replaces the
// program's operator new.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace pelage::test {
inline std::atomic<std::uint64_t> allocations{0};
}

// Every allocation of the program passes here. Not inlined: the compiler would see malloc meet delete and warn.
__attribute__((noinline)) void* operator new(std::size_t size) {
    ++pelage::test::allocations;
    if (void* p = std::malloc(size != 0 ? size : 1)) return p;
    throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* p) noexcept {
    std::free(p);
}
__attribute__((noinline)) void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
