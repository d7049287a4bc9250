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
    // `nodes` as placed, the import scale included. All must outlive it.
    GltfSkins(const GltfDocument& document, const InputFile& file, const std::vector<PlacedNode>& nodes);

    // From the space of a mesh to the world, for each joint of the skin. Throws Error(inputRefused), starting
    // with `label` when there is no such skin, for joints that are not in the scene, and for inverse bind
    // matrices that do not fit.
    std::vector<glm::dmat4> matrices(int skin, const std::string& label) const;

  private:
    const GltfDocument& document_;
    const InputFile& file_;
    std::vector<GltfElement> skins_;
    std::vector<const glm::dmat4*> toWorld_; // [node]; null outside the scene
};

// Carries the part to the world, vertex by vertex with the mean of its joints' matrices. Triangles that
// mirroring joints turn over are turned back. Throws Error(inputRefused) for a part without joints and for
// joints that the skin does not have.
void applySkin(const InputFile& file, const std::vector<glm::dmat4>& matrices, GltfPart& part);

} // namespace metamarch
