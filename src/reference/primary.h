// SPDX-License-Identifier: MIT
// The `primary` integrator on the CPU, over the stack traversal.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/rows.h"
#include "metamarch/shared/primary.h"

#include <span>
#include <vector>

namespace metamarch {

// One pixel for each of camera.width * camera.height, in rows from the top, on all cores. Cancelled rows hold
// emptyPixel().
std::vector<FilmPixel> renderPrimaryOnCpu(const AccelerationStructure& structure,
                                          std::span<const ShadingMaterial> materials,
                                          std::span<const std::uint32_t> materialOfTriangle,
                                          const Camera& camera, const OnProgress& onProgress = {});

} // namespace metamarch
