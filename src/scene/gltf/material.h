// SPDX-License-Identifier: MIT
// glTF materials.
#pragma once
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/gltf/texture.h"
#include "metamarch/scene/material.h"

#include <array>

namespace metamarch {

struct GltfMaterial {
    Material material; // its textures are indices into GltfTextures::textures()
    // The TEXCOORD_n of a primitive that the material's texture coordinates 0 and 1 stand for.
    std::array<std::uint32_t, 2> texCoordSets = {0, 1};
};

// Clamps factors to their range and multiplies lengths by |scale|. Throws Error(inputRefused) if a value has
// the wrong type or the material uses more than two sets of texture coordinates.
GltfMaterial readMaterial(const GltfElement& source, GltfTextures& textures, double scale);

} // namespace metamarch
