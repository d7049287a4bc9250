// SPDX-License-Identifier: MIT
// Arguments that are several numbers: x,y,z and WxH.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace metamarch {

// "x,y,z", three finite numbers. Throws Error(invalidArgument).
glm::dvec3 parsePoint(const std::string& text);

// "U" for all three axes or "Ux,Uy,Uz". Throws Error(invalidArgument).
glm::dvec3 parseOneOrThree(const std::string& text);

// "WxH", both at least 1. Throws Error(invalidArgument) for anything else and Error(outOfMemory) for a
// picture over kMaxPixels.
glm::uvec2 parseSize(const std::string& text);

// Pixels of a picture: they take about 100 bytes each while it is rendered and written.
inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 27u;

} // namespace metamarch
