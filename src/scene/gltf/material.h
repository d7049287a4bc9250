// SPDX-License-Identifier: MIT
// glTF materials.
#pragma once
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/gltf/texture.h"
#include "metamarch/scene/material.h"

#include <array>

namespace metamarch {

// The TEXCOORD_n of a primitive that a material's texture coordinates 0 to 3 stand for, or kNoTexCoordSet.
using TexCoordSets = std::array<std::uint32_t, 4>;
inline constexpr std::uint32_t kNoTexCoordSet = 0xffffffffu;
inline constexpr TexCoordSets kFirstTexCoordSets = {0, 1, kNoTexCoordSet, kNoTexCoordSet};

struct GltfMaterial {
    Material material; // its textures are indices into GltfTextures::textures()
    TexCoordSets texCoordSets = kFirstTexCoordSets;
};

// Clamps factors to their range and multiplies lengths by |scale|. Throws Error(inputRefused) if a value has
// the wrong type or the material uses more than four sets of texture coordinates.
GltfMaterial readMaterial(const GltfElement& source, GltfTextures& textures, double scale);

} // namespace metamarch
