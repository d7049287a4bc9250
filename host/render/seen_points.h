// SPDX-License-Identifier: MIT
// What the first sample of each pixel sees of the scene, beyond what the film holds.
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/path_settings.h"

#include <span>
#include <vector>

namespace metamarch::render {

// `pixels` is a film of an area of the camera's picture. `path` has the settings of the path tracer that made
// it; null: `primary` did. The ray of a first sample follows from camera and seed, and its triangle is in the
// film, so nothing is traced.
std::vector<SeenPoint> seenPoints(const PreparedScene& scene, const Camera& camera, const PixelRect& area,
                                  const PathSettings* path, std::span<const FilmPixel> pixels);

} // namespace metamarch::render
