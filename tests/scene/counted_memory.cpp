// SPDX-License-Identifier: MIT
#include "scene/counted_memory.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

std::atomic<std::size_t> inUse{0};
std::atomic<std::size_t> mostInUse{0};

} // namespace

#if !defined(__SANITIZE_ADDRESS__)
void* operator new(std::size_t size) {
    void* memory = std::malloc(size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    const std::size_t now = inUse += malloc_usable_size(memory);
    std::size_t most = mostInUse;
    while (now > most && !mostInUse.compare_exchange_weak(most, now)) {
    }
    return memory;
}

void operator delete(void* memory) noexcept {
    inUse -= malloc_usable_size(memory);
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
#endif

namespace metamarch {

std::size_t bytesInUse() { return inUse; }
std::size_t mostBytesInUse() { return mostInUse; }
void watchMemory() { mostInUse = inUse.load(); }

} // namespace metamarch
