// SPDX-License-Identifier: MIT
// What lies under a pixel of the window: found on the CPU, by the judge.
#pragma once
#include "metamarch/reference/march_log.h"
#include "metamarch/shared/camera.h"
#include "metamarch/viewer/scene_loader.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace metamarch::viewer {

struct Pick {
    std::uint32_t triangleId; // of LoadedScene::shown.scene
    std::uint32_t mesh;
    std::uint32_t material; // kNoMaterial: none
    glm::vec3 corners[3];
    glm::vec3 position;
    float distance; // from the eye
    float depth;    // along the view; of a panorama the distance
};

// The ray through a point of the picture, in pixels from its upper left corner, through the lens's centre.
Ray rayThrough(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

// Nothing where the ray meets nothing.
std::optional<Pick> pick(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

// A ray that stays where it was while the camera moves around it.
struct FrozenMarch {
    glm::vec3 origin;
    glm::vec3 dir; // of unit length
    MarchLog log;
};
FrozenMarch marchThrough(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

} // namespace metamarch::viewer
