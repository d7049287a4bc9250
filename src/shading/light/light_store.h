// Everything that sends light, in the records and the table that light sampling draws from.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shared/shading_scene.h"

#include <span>

namespace metamarch {

// `meanEmission[material]`: radiance, textures averaged; black where light sampling is not to know the
// material. Fills what of `target` is about light; its surfaces and materials are there.
void addLights(std::span<const PunctualLight> lights, const Scene& scene, const Surroundings& surroundings,
               std::span<const glm::vec3> meanEmission, ShadingScene& target);

} // namespace metamarch
