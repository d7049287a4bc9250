// SPDX-License-Identifier: MIT
// Reads the geometry of glTF meshes, primitive by primitive.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/gltf/material.h"
#include "metamarch/scene/mesh_geometry.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// A joint of a skin and its weight for a vertex.
struct JointInfluence {
    std::uint32_t joint = 0;
    float weight = 0.0f;
};

// One primitive in the space of its mesh, with morph targets applied.
struct GltfPart {
    std::string label;      // "mesh 'body' primitive 0"
    std::uint32_t material; // index, or kNoMaterial
    MeshGeometry geometry;
    std::vector<JointInfluence> influences; // the same number for every vertex; empty without JOINTS_0
};

class GltfMeshes {
  public:
    // `texCoordSets` gives, for each material of the file, the TEXCOORD_n that are its sets.
    // `variant` is an index into the file's variants. All arguments must outlive the object.
    GltfMeshes(const GltfDocument& document, InputFile& file, const std::vector<TexCoordSets>& texCoordSets,
               std::optional<int> variant);

    // Returns every primitive that has triangles: lists, strips and fans, indexed or not. Points and lines
    // cause a warning. Morph targets are applied with `weights`, or with the mesh's own weights if that is
    // empty. Tangents without normals are dropped. Throws Error(inputRefused) if anything is inconsistent or
    // if there is no such mesh; the latter message starts with `label`.
    std::vector<GltfPart> read(int mesh, const std::vector<double>& weights, const std::string& label) const;

  private:
    const GltfDocument& document_;
    InputFile& file_;
    const std::vector<TexCoordSets>& texCoordSets_;
    std::optional<int> variant_;
    std::vector<GltfElement> meshes_;
};

} // namespace metamarch
