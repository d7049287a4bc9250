// EXT_mesh_gpu_instancing: one node, many places.
#pragma once
#include "scene/gltf_element.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <vector>

namespace metamarch {

// From the mesh of a node to the node, for each instance; the identity alone without the extension. Throws
// Error(sceneRefused) for attributes of different counts.
std::vector<glm::dmat4> instanceMatrices(const tinygltf::Model& model, const SceneFile& file,
                                         const GltfElement& node);

} // namespace metamarch
