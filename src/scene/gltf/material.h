// glTF materials.
#pragma once
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/gltf/texture.h"
#include "metamarch/scene/material.h"

#include <array>

namespace metamarch {

struct GltfMaterial {
    Material material; // its textures are indices into GltfTextures::textures()
    // Which TEXCOORD_n of a primitive the material's texture coordinates 0 and 1 are.
    std::array<std::uint32_t, 2> texCoordSets = {0, 1};
};

// Factors outside their range are clamped to it; lengths are multiplied by |scale|. Throws
// Error(inputRefused) for values of wrong types, and where more than two sets of texture coordinates are
// wanted.
GltfMaterial readMaterial(const GltfElement& source, const GltfTextures& textures, double scale);

} // namespace metamarch
