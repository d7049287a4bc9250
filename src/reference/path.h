// SPDX-License-Identifier: MIT
// The path tracer on the CPU, over the stack traversal: the judge of shaders/kernels/path.glsl.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/rows.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/path_settings.h"
#include "metamarch/shared/shading_scene.h"

namespace metamarch {

// Returns camera.width * camera.height pixels with `samples` samples each, and what `request` asks for
// besides. Uses all cores. Rows that are cancelled stay empty.
FilmData renderPathsOnCpu(const AccelerationStructure& structure, const ShadingScene& scene,
                          const PathSettings& settings, const Camera& camera, std::uint32_t samples,
                          const FilmRequest& request, const OnProgress& onProgress = {});

} // namespace metamarch
