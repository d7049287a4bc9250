// glTF's punctual lights (KHR_lights_punctual), placed by their node.
#pragma once
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>

#include <optional>

namespace metamarch {

// Shines along the node's -z axis. `toWorld` includes the import scale, by whose square candelas are
// multiplied; of the node's own scale only the directions count. Nothing when the node's matrix gives the
// light no place or direction; the name is the light's own. Throws Error(inputRefused) for an unknown type.
std::optional<PunctualLight> readLight(const GltfElement& source, const glm::dmat4& toWorld, double scale);

} // namespace metamarch
