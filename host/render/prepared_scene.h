// SPDX-License-Identifier: MIT
// A scene that is ready to be rendered: with its acceleration structure and its light.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/scene/scene.h"
#include "metamarch/shading/light_choice.h"
#include "metamarch/shading/path_choice.h"
#include "metamarch/shared/shading_scene.h"

#include <memory>
#include <string>
#include <vector>

namespace metamarch::render {

// Copies share scene, structure and light. These never change, so threads may render at the same time.
struct PreparedScene {
    // Builds the structure. Throws what buildAccelerationStructure throws.
    PreparedScene(std::shared_ptr<const Scene> usedScene, const AccelerationOptions& options);

    // Lights the scene for the path tracer; replaces the light that it had. Warnings call the scene `name`.
    // Throws what makeSurroundings and makeShadingScene throw.
    void light(const std::string& name, const PathChoice& path, const LightChoice& choice);

    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const AccelerationStructure> structure; // over `scene`
    std::shared_ptr<const ShadingScene> shading;            // null before light(); `primary` needs none
    ShadingOptions shadingOptions;                          // of `shading`

    std::vector<std::string> lightWarnings; // one line each, for the user
};

// Returns warnings about a structure for the user, one line each.
std::vector<std::string> warningsOf(const AccelerationStructure& structure);

} // namespace metamarch::render
