// SPDX-License-Identifier: MIT
// Reads a file with rays of the user.
#pragma once
#include "metamarch/bench/ray_set.h"

#include <filesystem>

namespace metamarch::bench {

// The file holds six little-endian float32 per ray, origin and direction, and nothing else. The rays look for
// the closest hit at any distance. Throws Error(inputRefused) if the file cannot be read, is empty or does
// not contain whole rays, and, naming the ray, if a number is not finite or a direction is zero.
RaySet readRayFile(const std::filesystem::path& path);

} // namespace metamarch::bench
