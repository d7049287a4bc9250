// SPDX-License-Identifier: MIT
// The integrator `primary` on the CPU, with the stack traversal.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/pieces.h"
#include "metamarch/shared/primary.h"

#include <span>
#include <vector>

namespace metamarch {

// Returns camera.width * camera.height pixels in rows from the top. Uses all cores. Rows that are cancelled
// hold emptyPixel().
std::vector<FilmPixel> renderPrimaryByJudge(const AccelerationStructure& structure,
                                            std::span<const ShadingMaterial> materials,
                                            std::span<const std::uint32_t> materialOfTriangle,
                                            const Camera& camera, const OnProgress& onProgress = {});

} // namespace metamarch
