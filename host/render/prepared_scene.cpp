// SPDX-License-Identifier: MIT
#include "metamarch/render/prepared_scene.h"

#include "metamarch/shading/surroundings.h"

#include <fmt/format.h>

#include <utility>

namespace metamarch::render {

PreparedScene::PreparedScene(std::shared_ptr<const Scene> usedScene, const AccelerationOptions& options)
    : scene(std::move(usedScene)),
      structure(std::make_shared<const AccelerationStructure>(buildAccelerationStructure(*scene, options))) {}

void PreparedScene::light(const std::string& name, const PathChoice& path, const LightChoice& choice) {
    Surroundings surroundings;
    if (path.isOcclusion()) {
        surroundings.background = glm::vec3(1.0f);
    } else {
        surroundings = makeSurroundings(*scene, name, choice);
    }
    shadingOptions = path.shading();
    shading = std::make_shared<const ShadingScene>(makeShadingScene(*scene, surroundings, shadingOptions));
    lightWarnings = surroundings.warnings;
}

std::vector<std::string> warningsOf(const AccelerationStructure& structure) {
    if (structure.degenerateTriangles == 0 || structure.lattice.triangleCount > 0) {
        return {};
    }
    return {
        fmt::format("all {} triangles are degenerate, nothing is visible; if the scene is tiny, scale it up",
                    structure.degenerateTriangles)};
}

} // namespace metamarch::render
