// SPDX-License-Identifier: MIT
#include "traversal/gpu_scenes.h"

#include "fixtures/shapes.h"
#include "fixtures/shared_scenes.h"
#include "metamarch/scene/import.h"

#include <algorithm>

namespace metamarch::tests {

const std::vector<GpuScene>& gpuScenes() {
    static const std::vector<GpuScene> kScenes = {
        {"bunny", "paper/bunny.ply", 1.0f, {glm::dvec3(0.002), {}, kPaperTreeDepth}},
        {"dragon", "mesh/dragon_202k.ply"},
        {"sponza", "mesh/sponza_66k.obj"},
        {"helmet", "gltf/DamagedHelmet.glb"},
        {"sphere_in_stadium", "", 1.0f, {}, true},
        {"degenerate", "scenes/degenerate.glb"},
        {"cornell", "scenes/cornell.glb"},
        {"objects", "scenes/objects.glb"},
        {"objects_as_in_the_paper", "scenes/objects.glb", 1.0f, {glm::dvec3(0.1), {}, kPaperTreeDepth}},
    };
    return kScenes;
}

namespace {

Scene loadModel(const GpuScene& scene) {
    if (scene.file.empty()) {
        Scene made;
        addSphere(made, {0, 1, 0}, 1.0f, 40, 20);
        return made;
    }
    const std::filesystem::path file = scene.file.starts_with("scenes/")
                                           ? std::filesystem::path(METAMARCH_SOURCE_DIR) / scene.file
                                           : sharedScene(scene.file);
    return loadScene(file, {.scale = scene.scale});
}

} // namespace

Scene load(const GpuScene& scene) {
    Scene loaded = loadModel(scene);
    if (scene.inStadium) {
        const Bounds bounds = boundsOf(loaded);
        const glm::vec3 size = bounds.hi - bounds.lo;
        addPlane(loaded, bounds.lo.y, 5000.0f * std::max({size.x, size.y, size.z}));
    }
    return loaded;
}

} // namespace metamarch::tests
