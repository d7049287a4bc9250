// SPDX-License-Identifier: MIT
// What is known of the pixel under the cursor, in lines.
#pragma once
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film.h"
#include "metamarch/viewer/scene_loader.h"
#include "metamarch/viewer/split_view.h"
#include "metamarch/viewer/viewer_state.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace metamarch::viewer {

// Returns the film's channels of a pixel; nothing but their absence if it has no samples.
std::vector<std::string> channelLines(const FilmPixel& pixel);

// Returns what the ray through the point `place` of the window meets: mesh, material, point, and the table's
// entry.
std::vector<std::string> hitLines(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

// Returns both for the pixel under the cursor, with the film of its side; nothing where they are not wanted.
// A view or a kept picture has no film. Call it only with a scene.
std::vector<std::string> readOutLines(const ViewerState& state, const SplitView& shown);

} // namespace metamarch::viewer
