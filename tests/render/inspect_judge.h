// SPDX-License-Identifier: MIT
// The pictures of the kernels `inspect` and `cells`, drawn by the twins on the CPU.
#pragma once
#include "metamarch/accel/structure_set.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch::tests {

// Packed pixels in rows. `traversal` must have a twin; views of cells are the meta table's without it.
std::vector<std::uint32_t> inspectOnCpu(const StructureSet& scene, const ShadingScene& shading,
                                        const std::string& traversal, const Camera& camera,
                                        std::uint32_t view, float scaleMax);

} // namespace metamarch::tests
