// SPDX-License-Identifier: MIT
// Flattens the node hierarchy of a glTF scene.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/gltf/document.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace metamarch {

struct PlacedNode {
    int node;
    int root; // the topmost node above it, or itself
    glm::dmat4 toWorld;
    // False if KHR_node_visibility hides the node or one above it. Its mesh and light are not part of the
    // picture; its camera is, and so are meshes that it moves as a joint.
    bool visible = true;
};

// Returns every node of the scene that `scene` names or numbers; if that is empty, of the default scene
// (without one: of scene 0; without scenes: of all root nodes). Parents come before their children; `root` is
// applied last. Throws Error(inputRefused) for indices out of range, for a node that is reached twice (a
// cycle, or two parents) and for a transform that does not have 3, 4 or 16 numbers, and
// Error(invalidArgument) for an unknown `scene`.
std::vector<PlacedNode> placeNodes(const GltfDocument& document, const InputFile& file,
                                   const std::string& scene, const glm::dmat4& root);

// Combines translation, rotation (a quaternion of any length but zero) and scale in glTF's order.
glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotationXyzw, const glm::dvec3& scale);

} // namespace metamarch
