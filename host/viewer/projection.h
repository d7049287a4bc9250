// SPDX-License-Identifier: MIT
// Projects points of the world to the window.
#pragma once
#include "metamarch/shared/camera.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace metamarch::viewer {

// Returns the ends of the part of a segment that is in front of the camera, in pixels of its picture. Returns
// nothing if no part is, and for panoramas, which show a segment as a curve.
std::optional<std::array<glm::vec2, 2>> project(const Camera& camera, const glm::vec3& from,
                                                const glm::vec3& to);

} // namespace metamarch::viewer
