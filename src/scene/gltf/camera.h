// glTF cameras, placed by their node.
#pragma once
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <optional>

namespace metamarch {

// Looks along the node's -z axis. `toWorld` includes the import scale; of the node's own scale only the
// directions count (glTF 2.0, 3.10.2). Sizes are multiplied by |scale|. Nothing when the camera's numbers or
// its node's matrix define no picture; the name is left empty.
std::optional<SceneCamera> readCamera(const tinygltf::Camera& source, const glm::dmat4& toWorld,
                                      double scale);

} // namespace metamarch
