// SPDX-License-Identifier: MIT
// Draws the pictures of the kernels `inspect` and `cells` on the CPU, with the twins.
#pragma once
#include "metamarch/accel/structure_set.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch::tests {

// Returns packed pixels in rows. `traversal` must have a twin. Views of cells ignore it and use the meta
// table.
std::vector<std::uint32_t> inspectOnCpu(const StructureSet& scene, const ShadingScene& shading,
                                        const std::string& traversal, const Camera& camera,
                                        std::uint32_t view, float scaleMax, float scaleMin = 0.0f);

} // namespace metamarch::tests
