// SPDX-License-Identifier: MIT
// Finds the volumes that a camera is inside of.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/shared/media.h"
#include "metamarch/shared/shading_scene.h"

#include <glm/glm.hpp>

namespace metamarch {

// Returns the media around a point in world space, the innermost first. Follows a ray from there out of the
// scene: a surface whose back it meets, and whose front it has not met before, bounds a volume around the
// point. Costs one ray, and nothing for scenes without volumes.
Media mediaAt(const AccelerationStructure& structure, const ShadingScene& scene, glm::vec3 point);

} // namespace metamarch
