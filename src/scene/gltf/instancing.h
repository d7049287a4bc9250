// SPDX-License-Identifier: MIT
// EXT_mesh_gpu_instancing: draws a node's mesh at many places.
#pragma once
#include "metamarch/scene/gltf/element.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <vector>

namespace metamarch {

// Returns, for each instance, the transform from the mesh to the node; a single identity if the node lacks
// the extension. Throws Error(inputRefused) if the attributes have different counts.
std::vector<glm::dmat4> instanceMatrices(const tinygltf::Model& model, const InputFile& file,
                                         const GltfElement& node);

} // namespace metamarch
