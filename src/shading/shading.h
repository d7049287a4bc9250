// SPDX-License-Identifier: MIT
// What shading reads of a scene, in the layout that crosses the bus.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shared/scene_layout.h"

#include <cstdint>
#include <vector>

namespace metamarch {

// The scene's materials, and after them a grey one for the triangles that have none.
std::vector<Material> materialsWithGrey(const Scene& scene);

// Where the triangle's material is among materialsWithGrey().
std::uint32_t materialOf(const Scene& scene, std::size_t triangleId);

struct ShadingData {
    std::vector<ShadingMaterial> materials;        // of materialsWithGrey()
    std::vector<std::uint32_t> materialOfTriangle; // [triangleId], materialOf()
};

ShadingData makeShadingData(const Scene& scene);

} // namespace metamarch
