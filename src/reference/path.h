// SPDX-License-Identifier: MIT
// The path tracer on the CPU, over the stack traversal: the judge of shaders/kernels/path.glsl.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/pieces.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/path_settings.h"
#include "metamarch/shared/shading_scene.h"

namespace metamarch {

// Takes samples of the pixels of an area until each has `samples` of its block, which begins with sample
// number `firstSample`. `block` covers the area and holds what has been taken of the block before. Uses all
// cores. Calls `onProgress` after each tile; cancelled tiles stay as they are, and then it returns false.
bool takeBlockByJudge(const AccelerationStructure& structure, const ShadingScene& scene,
                      const PathSettings& settings, const Camera& camera, const PixelRect& area,
                      std::uint32_t firstSample, std::uint32_t samples, const FilmRequest& request,
                      FilmData& block, const OnProgress& onProgress = {});

// Returns camera.width * camera.height pixels with `samples` samples each, and what `request` asks for
// besides.
FilmData renderPathsByJudge(const AccelerationStructure& structure, const ShadingScene& scene,
                            const PathSettings& settings, const Camera& camera, std::uint32_t samples,
                            const FilmRequest& request);

} // namespace metamarch
