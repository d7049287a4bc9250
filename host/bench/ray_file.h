// Rays of the user: --rays FILE.
#pragma once
#include "metamarch/bench/ray_set.h"

#include <filesystem>

namespace metamarch::bench {

// Six little-endian float32 per ray, origin and direction, nothing else. Closest hits, of any distance.
// Throws Error(inputRefused) for a file that cannot be read, is empty or not of whole rays, and for a number
// that is not finite or a direction of zero, naming the ray.
RaySet readRayFile(const std::filesystem::path& path);

} // namespace metamarch::bench
