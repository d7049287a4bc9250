// glTF skins: vertices that follow several nodes.
#pragma once
#include "scene/gltf_document.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_node.h"

#include <glm/glm.hpp>

#include <vector>

namespace metamarch {

class GltfSkins {
  public:
    // `nodes` as placed, the import scale included. All must outlive it.
    GltfSkins(const GltfDocument& document, const SceneFile& file, const std::vector<PlacedNode>& nodes);

    // From the space of a mesh to the world, for each joint of the skin. Throws Error(sceneRefused), starting
    // with `label` when there is no such skin, for joints that are not in the scene, and for inverse bind
    // matrices that do not fit.
    std::vector<glm::dmat4> matrices(int skin, const std::string& label) const;

  private:
    const GltfDocument& document_;
    const SceneFile& file_;
    std::vector<GltfElement> skins_;
    std::vector<const glm::dmat4*> toWorld_; // [node]; null outside the scene
};

// Carries the part to the world, vertex by vertex with the mean of its joints' matrices. Triangles that
// mirroring joints turn over are turned back. Throws Error(sceneRefused) for a part without joints and for
// joints that the skin does not have.
void applySkin(const SceneFile& file, const std::vector<glm::dmat4>& matrices, GltfPart& part);

} // namespace metamarch
