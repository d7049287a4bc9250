// SPDX-License-Identifier: MIT
// Builds the records of everything that sends light, and the table from which light sampling draws.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shared/shading_scene.h"

#include <span>

namespace metamarch {

// `meanEmission` is indexed by material: the radiance, averaged over textures, or black if light sampling
// should ignore the material. Fills the light-related members of `target`, whose surfaces and materials must
// be there already.
void addLights(std::span<const PunctualLight> lights, const Scene& scene, const Surroundings& surroundings,
               std::span<const glm::vec3> meanEmission, ShadingScene& target);

} // namespace metamarch
