// SPDX-License-Identifier: MIT
// glTF's punctual lights (KHR_lights_punctual), placed by their nodes.
#pragma once
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>

#include <optional>

namespace metamarch {

// The light shines along the node's -z axis. `toWorld` includes the import scale; candelas are multiplied by
// the square of `scale`. From the rest of the node's scale only the directions count. Returns nothing if the
// node's matrix gives the light no position or direction. The name is the light's own. Throws
// Error(inputRefused) for an unknown type.
std::optional<PunctualLight> readLight(const GltfElement& source, const glm::dmat4& toWorld, double scale);

} // namespace metamarch
