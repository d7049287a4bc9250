// SPDX-License-Identifier: MIT
// Finds equal attributes and equal corners, of which one vertex is made.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// Returns for each value the index of the first that equals it. -0 equals 0, and a NaN equals the same NaN.
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec2> values);
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec3> values);
std::vector<std::uint32_t> firstEqual(std::span<const glm::vec4> values);

// What a corner of a face has: indices of its position, normal, texture coordinate and colour.
using CornerIndices = glm::uvec4;

struct JoinedCorners {
    std::vector<std::uint32_t> vertex; // of each corner; an index into kept
    std::vector<std::uint32_t> kept;   // the first of each group of equal corners, in order
};

JoinedCorners joinCorners(std::span<const CornerIndices> corners);

} // namespace metamarch
