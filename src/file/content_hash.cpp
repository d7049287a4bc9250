// SPDX-License-Identifier: MIT
#include "metamarch/file/content_hash.h"

#include <array>
#include <cstdio>
#include <cstring>

namespace metamarch {

// The mixing function of SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
// 2014).
void ContentHash::mix(const std::uint64_t word) {
    std::uint64_t z = (state ^ word) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
    state = z ^ (z >> 31u);
}

void ContentHash::add(const std::span<const std::byte> bytes) {
    mix(bytes.size());
    std::size_t at = 0;
    for (; at + sizeof(std::uint64_t) <= bytes.size(); at += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof(word));
        mix(word);
    }
    if (at < bytes.size()) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, bytes.size() - at);
        mix(word);
    }
}

std::string ContentHash::text() const {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(state));
    return digits.data();
}

} // namespace metamarch
