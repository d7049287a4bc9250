// SPDX-License-Identifier: MIT
// Builds the light that does not come from the scene's file.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/light/environment.h"
#include "metamarch/shading/light_choice.h"
#include "metamarch/shared/light.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace metamarch {

struct Surroundings {
    glm::vec3 background{0.0f};             // radiance from all directions, if there is no map
    std::optional<Environment> environment; // not empty
    float rotation = 0.0f;                  // radians; turns the map around y, from +z towards +x
    float intensity = 1.0f;                 // factor of the map's radiance, at least 0
    std::optional<LightRecord> sun;         // a kLightDisc
    std::vector<std::string> warnings;      // one line each, for the user
};

// Returns true if the scene's file has light that can illuminate it: a punctual light or an emissive surface.
// A surface with an emissive texture of strength at most 1 does not count; it is a display and not a lamp.
bool hasLight(const Scene& scene);

// Reads the map or makes the sky. Warnings call the scene `name`. Throws what loadEnvironment throws.
Surroundings makeSurroundings(const Scene& scene, const std::string& name, const LightChoice& light);

} // namespace metamarch
