// SPDX-License-Identifier: MIT
// glTF skins: vertices that follow several nodes.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/mesh.h"
#include "metamarch/scene/gltf/node.h"

#include <glm/glm.hpp>

#include <vector>

namespace metamarch {

class GltfSkins {
  public:
    // `nodes` are the placed nodes, import scale included. All arguments must outlive the object.
    GltfSkins(const GltfDocument& document, const InputFile& file, const std::vector<PlacedNode>& nodes);

    // Returns, for each joint of the skin, the transform from mesh space to world space. Throws
    // Error(inputRefused) if there is no such skin (the message starts with `label`), if a joint is not in
    // the scene, or if the inverse bind matrices do not fit.
    std::vector<glm::dmat4> matrices(int skin, const std::string& label) const;

  private:
    const GltfDocument& document_;
    const InputFile& file_;
    std::vector<GltfElement> skins_;
    std::vector<const glm::dmat4*> toWorld_; // indexed by node; null if the node is not in the scene
};

// Transforms the part to world space; each vertex uses the weighted mean of its joints' matrices. Triangles
// that mirroring joints turn over are turned back. Throws Error(inputRefused) if the part has no joints or
// names a joint that the skin does not have.
void applySkin(const InputFile& file, const std::vector<glm::dmat4>& matrices, GltfPart& part);

} // namespace metamarch
