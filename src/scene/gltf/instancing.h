// EXT_mesh_gpu_instancing: one node, many places.
#pragma once
#include "metamarch/scene/gltf/element.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <vector>

namespace metamarch {

// From the mesh of a node to the node, for each instance; the identity alone without the extension. Throws
// Error(inputRefused) for attributes of different counts.
std::vector<glm::dmat4> instanceMatrices(const tinygltf::Model& model, const InputFile& file,
                                         const GltfElement& node);

} // namespace metamarch
