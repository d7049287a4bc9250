// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/vertex_join.h"

#include <array>
#include <bit>
#include <random>

namespace metamarch {
namespace {

constexpr std::uint32_t kFree = 0xffffffffu;

template <glm::length_t n>
std::array<std::uint32_t, n> keyOf(const glm::vec<n, float>& value) {
    // Bits rather than floats: a NaN then equals itself and is reported later.
    std::array<std::uint32_t, n> key;
    for (glm::length_t i = 0; i < n; ++i) {
        key[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(value[i] + 0.0f);
    }
    return key;
}

std::array<std::uint32_t, 4> keyOf(const glm::uvec4& corner) {
    return {corner.x, corner.y, corner.z, corner.w};
}

// FNV-1a, one word at a time, and the last step of MurmurHash3, which mixes the high bits into the low ones.
// It begins with a random number, so that no file can choose values with equal hashes. The result of a search
// does not depend on it.
template <std::size_t n>
std::size_t hashOf(const std::array<std::uint32_t, n>& key) {
    static const std::uint64_t start = 0xcbf29ce484222325u ^ (std::uint64_t{std::random_device()()} << 32);
    std::uint64_t hash = start;
    for (const std::uint32_t word : key) {
        hash = (hash ^ word) * 0x100000001b3u;
    }
    hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdu;
    return static_cast<std::size_t>(hash ^ (hash >> 33));
}

// Calls `visit(i, first)` for each value in order, `first` being the index of the first that equals it. The
// table has at least twice as many places as values and each place holds the index of a value.
template <class T, class Visit>
void forEachFirst(std::span<const T> values, const Visit& visit) {
    const std::size_t places = std::bit_ceil(2 * values.size() + 1);
    std::vector<std::uint32_t> table(places, kFree);
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        const auto key = keyOf(values[i]);
        std::size_t place = hashOf(key) & (places - 1);
        while (table[place] != kFree && keyOf(values[table[place]]) != key) {
            place = (place + 1) & (places - 1);
        }
        if (table[place] == kFree) {
            table[place] = i;
        }
        visit(i, table[place]);
    }
}

template <class T>
std::vector<std::uint32_t> allFirst(std::span<const T> values) {
    std::vector<std::uint32_t> first;
    first.reserve(values.size());
    forEachFirst(values, [&first](std::uint32_t, std::uint32_t index) { first.push_back(index); });
    return first;
}

} // namespace

std::vector<std::uint32_t> firstEqual(std::span<const glm::vec2> values) { return allFirst(values); }
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec3> values) { return allFirst(values); }
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec4> values) { return allFirst(values); }

JoinedCorners joinCorners(std::span<const CornerIndices> corners) {
    JoinedCorners joined;
    joined.vertex.reserve(corners.size());
    forEachFirst(corners, [&joined](std::uint32_t corner, std::uint32_t first) {
        if (corner == first) {
            joined.vertex.push_back(static_cast<std::uint32_t>(joined.kept.size()));
            joined.kept.push_back(corner);
        } else {
            joined.vertex.push_back(joined.vertex[first]);
        }
    });
    return joined;
}

} // namespace metamarch
