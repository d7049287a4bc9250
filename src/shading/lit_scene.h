// A scene under the light and for the integrator that a user asks for.
#pragma once
#include "metamarch/shading/light_choice.h"
#include "metamarch/shading/path_choice.h"
#include "metamarch/shared/shading_scene.h"

#include <string>
#include <vector>

namespace metamarch {

// Whether something in the scene's file shines that it can be seen by. What glows by a texture of strength 1
// is a lit display, and no lamp.
bool hasLight(const Scene& scene);

struct LitScene {
    ShadingScene shading;
    std::vector<std::string> warnings; // one line each, for the user
};

// Reads the map or makes the sky. `name` is what warnings call the scene. Throws what loadEnvironment and
// makeShadingScene throw.
LitScene lightScene(const Scene& scene, const std::string& name, const PathChoice& path,
                    const LightChoice& light);

} // namespace metamarch
