// glTF meshes to geometry, primitive by primitive.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/mesh_geometry.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// A joint of a skin and its share in a vertex.
struct JointInfluence {
    std::uint32_t joint = 0;
    float weight = 0.0f;
};

// One primitive, in the mesh's own space, morphed.
struct GltfPart {
    std::string label;      // "mesh 'body' primitive 0"
    std::uint32_t material; // or kNoMaterial
    MeshGeometry geometry;
    std::vector<JointInfluence> influences; // the same number for each vertex; empty without JOINTS_0
};

class GltfMeshes {
  public:
    // `texCoordSets`: for each material of the file which TEXCOORD_n are its sets 0 and 1. `variant`: an
    // index into the file's variants. All must outlive it.
    GltfMeshes(const GltfDocument& document, InputFile& file,
               const std::vector<std::array<std::uint32_t, 2>>& texCoordSets, std::optional<int> variant);

    // Every primitive that has triangles: lists, strips and fans, indexed or not. Points and lines get a
    // warning. Morph targets are added with `weights`, or the mesh's own where it is empty. Tangents without
    // normals are left out. Throws Error(inputRefused) for whatever does not fit together, and starting with
    // `label` when there is no such mesh.
    std::vector<GltfPart> read(int mesh, const std::vector<double>& weights, const std::string& label) const;

  private:
    const GltfDocument& document_;
    InputFile& file_;
    const std::vector<std::array<std::uint32_t, 2>>& texCoordSets_;
    std::optional<int> variant_;
    std::vector<GltfElement> meshes_;
};

} // namespace metamarch
