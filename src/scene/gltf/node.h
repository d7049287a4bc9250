// SPDX-License-Identifier: MIT
// Flattens the node hierarchy of a glTF scene.
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <vector>

namespace metamarch {

struct PlacedNode {
    int node;
    glm::dmat4 toWorld;
};

// Returns every node of the default scene (without one: of scene 0; without scenes: of all root nodes).
// Parents come before their children; `root` is applied last. Throws Error(inputRefused) for indices out of
// range, for a node that is reached twice (a cycle, or two parents) and for a transform that does not have 3,
// 4 or 16 numbers.
std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, const InputFile& file,
                                   const glm::dmat4& root);

// Combines translation, rotation (a quaternion of any length but zero) and scale in glTF's order.
glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotationXyzw, const glm::dvec3& scale);

} // namespace metamarch
