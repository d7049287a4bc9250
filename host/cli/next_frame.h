// SPDX-License-Identifier: MIT
// The scene of the next frame, for the channel `motion`.
#pragma once
#include "metamarch/cli/render_options.h"
#include "metamarch/render/seen_points.h"
#include "metamarch/scene/import.h"

#include <functional>
#include <memory>

namespace metamarch::cli {

// Reads the scene of the picture once more, at another time.
using SceneAt = std::function<std::shared_ptr<const Scene>(const ImportOptions&)>;

// Returns the scene a frame after options.import.time, which is set. A camera of the file moves as its
// animations say; any other stands still. `scene` is as it was read, and `camera` is that of its picture.
// Throws Error(inputRefused) for other triangles, and what `sceneAt` throws.
render::NextFrame nextFrame(const RenderOptions& options, const Scene& scene, const SceneCamera& camera,
                            const SceneAt& sceneAt);

} // namespace metamarch::cli
