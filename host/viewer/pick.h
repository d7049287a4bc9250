// SPDX-License-Identifier: MIT
// Finds what is under a pixel of the window, on the CPU, with the judge.
#pragma once
#include "metamarch/reference/march_log.h"
#include "metamarch/reference/walk_log.h"
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
    float depth;    // along the view axis; for a panorama, the distance
};

// Returns the ray through the lens's centre and the point `place` of the picture, in pixels from the
// picture's upper left corner.
Ray rayThrough(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

// Returns the hit of rayThrough(), or nothing if the ray hits no triangle.
std::optional<Pick> pick(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

// A ray, its march, and the stack traversal of the same ray. The ray stays where it is while the camera
// moves, so that it can be looked at.
struct FrozenMarch {
    glm::vec3 origin;
    glm::vec3 dir; // of unit length
    MarchLog log;
    WalkLog walk;
};
FrozenMarch marchThrough(const LoadedScene& scene, const Camera& camera, glm::vec2 place);

} // namespace metamarch::viewer
