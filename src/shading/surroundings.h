// SPDX-License-Identifier: MIT
// Light that does not come from the scene's file.
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
    glm::vec3 background{0.0f};             // radiance from everywhere, where there is no map
    std::optional<Environment> environment; // not empty
    float rotation = 0.0f;                  // radians; turns the map around y, from +z towards +x
    float intensity = 1.0f;                 // multiplies the map's radiance, at least 0
    std::optional<LightRecord> sun;         // a kLightDisc
    std::vector<std::string> warnings;      // one line each, for the user
};

// Whether something in the scene's file shines that it can be seen by. What glows by a texture of strength 1
// is a lit display, and no lamp.
bool hasLight(const Scene& scene);

// Reads the map or makes the sky. `name` is what warnings call the scene. Throws what loadEnvironment throws.
Surroundings makeSurroundings(const Scene& scene, const std::string& name, const LightChoice& light);

} // namespace metamarch
