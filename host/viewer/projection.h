// SPDX-License-Identifier: MIT
// World to window.
#pragma once
#include "metamarch/shared/camera.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace metamarch::viewer {

// The part of a segment before the camera, in pixels of its picture; nothing where no part is, and of
// panoramas, in which segments are no lines.
std::optional<std::array<glm::vec2, 2>> project(const Camera& camera, const glm::vec3& from,
                                                const glm::vec3& to);

} // namespace metamarch::viewer
