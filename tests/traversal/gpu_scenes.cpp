// SPDX-License-Identifier: MIT
#include "traversal/gpu_scenes.h"

#include "fixtures/shapes.h"
#include "fixtures/shared_scenes.h"
#include "metamarch/scene/import.h"

#include <algorithm>

namespace metamarch::tests {

const std::vector<GpuScene>& gpuScenes() {
    static const std::vector<GpuScene> kScenes = {
        {"cow", "paper/cow_viewpoint.obj", 0.1f, {glm::dvec3(0.02), {}, kPaperTreeDepth}},
        {"bunny", "paper/bunny.ply", 1.0f, {glm::dvec3(0.002), {}, kPaperTreeDepth}},
        {"dragon", "mesh/dragon_202k.ply"},
        {"sponza", "mesh/sponza_66k.obj"},
        {"helmet", "gltf/DamagedHelmet.glb"},
        {"teapot_in_stadium", "mesh/teapot.obj", 1.0f, {}, true},
        {"degenerate", "scenes/degenerate.glb"},
        {"cornell", "scenes/cornell.glb"},
        {"objects", "scenes/objects.glb"},
    };
    return kScenes;
}

Scene load(const GpuScene& scene) {
    const std::filesystem::path file = scene.file.starts_with("scenes/")
                                           ? std::filesystem::path(METAMARCH_SOURCE_DIR) / scene.file
                                           : sharedScene(scene.file);
    Scene loaded = loadScene(file, {.scale = scene.scale});
    if (scene.inStadium) {
        const Bounds bounds = boundsOf(loaded);
        const glm::vec3 size = bounds.hi - bounds.lo;
        addPlane(loaded, bounds.lo.y, 5000.0f * std::max({size.x, size.y, size.z}));
    }
    return loaded;
}

} // namespace metamarch::tests
