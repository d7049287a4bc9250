// SPDX-License-Identifier: MIT
// glTF cameras, placed by their nodes.
#pragma once
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <optional>

namespace metamarch {

// The camera looks along the node's -z axis. `toWorld` includes the import scale; from the rest of the node's
// scale only the directions count (glTF 2.0, 3.10.2). Sizes are multiplied by |scale|. Returns nothing if the
// camera's numbers or its node's matrix define no picture. The name is left empty.
std::optional<SceneCamera> readCamera(const tinygltf::Camera& source, const glm::dmat4& toWorld,
                                      double scale);

} // namespace metamarch
