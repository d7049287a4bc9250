// SPDX-License-Identifier: MIT
// The triangles that are one object of one material, and what Cryptomatte calls them.
#pragma once
#include "metamarch/image/cryptomatte.h"
#include "metamarch/scene/scene.h"

#include <cstdint>
#include <vector>

namespace metamarch::render {

struct SurfaceGroups {
    std::vector<std::uint32_t> ofTriangle;
    std::vector<CryptomatteLevel> levels; // objects, materials, assets
};

// An object is named after its node, otherwise after its mesh; an asset after the topmost node above it,
// otherwise like the object. What has no name is called "mesh 3" or "material 0", by its index in the file.
SurfaceGroups groupSurfaces(const Scene& scene);

} // namespace metamarch::render
