// SPDX-License-Identifier: MIT
// What the first sample of each pixel sees of the scene, beyond what the film holds.
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/render/prepared_scene.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/path_settings.h"

#include <memory>
#include <span>
#include <vector>

namespace metamarch::render {

// The scene a frame later: triangles and vertices have the same numbers.
struct NextFrame {
    std::shared_ptr<const Scene> scene;
    Camera camera;
};

// Throws Error(inputRefused) if the later scene has other triangles.
void checkNextFrame(const Scene& scene, const Scene& later);

// `pixels` is a film of an area of the camera's picture. `path` has the settings of the path tracer that made
// it; null: `primary` did. The ray of a first sample follows from camera and seed, and its triangle is in the
// film, so nothing is traced. Without a next frame (null) nothing moves.
std::vector<SeenPoint> seenPoints(const PreparedScene& scene, const Camera& camera, const PixelRect& area,
                                  const PathSettings* path, std::span<const FilmPixel> pixels,
                                  const NextFrame* next = nullptr);

} // namespace metamarch::render
