// What shading reads of a scene, in the layout that crosses the bus.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shared/scene_layout.h"

#include <vector>

namespace metamarch {

struct ShadingData {
    std::vector<ShadingMaterial> materials;        // the scene's, then a grey one for triangles without
    std::vector<std::uint32_t> materialOfTriangle; // [triangleId], always in range of `materials`
};

ShadingData makeShadingData(const Scene& scene);

} // namespace metamarch
