// SPDX-License-Identifier: MIT
// The data of a scene that the integrator `primary` reads, in the layout of the device's buffers.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shared/scene_layout.h"

#include <cstdint>
#include <vector>

namespace metamarch {

// Returns the scene's materials, followed by a grey one for triangles without a material.
std::vector<Material> materialsWithGrey(const Scene& scene);

// Returns the index of the triangle's material in materialsWithGrey().
std::uint32_t materialOf(const Scene& scene, std::size_t triangleId);

struct ShadingData {
    std::vector<ShadingMaterial> materials;        // in the order of materialsWithGrey()
    std::vector<std::uint32_t> materialOfTriangle; // [triangleId]; see materialOf()
};

ShadingData makeShadingData(const Scene& scene);

} // namespace metamarch
