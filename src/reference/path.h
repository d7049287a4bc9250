// The path tracer on the CPU, over the stack traversal: the judge of shaders/kernels/path.glsl.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film.h"
#include "metamarch/shared/path_settings.h"
#include "metamarch/shared/shading_scene.h"

#include <functional>
#include <vector>

namespace metamarch {

// `samples` samples of each of camera.width * camera.height pixels, in rows from the top. Multi-threaded;
// `onRows` is told of finished rows, from any thread.
std::vector<FilmPixel> renderPaths(const AccelerationStructure& structure, const ShadingScene& scene,
                                   const PathSettings& settings, const Camera& camera, std::uint32_t samples,
                                   const std::function<void(unsigned rows)>& onRows);

} // namespace metamarch
