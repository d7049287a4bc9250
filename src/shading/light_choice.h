// SPDX-License-Identifier: MIT
// Light that does not come from the scene's file, as a user asks for it.
#pragma once
#include <glm/glm.hpp>

#include <filesystem>

namespace metamarch {

struct LightChoice {
    enum class Kind {
        automatic,  // none where the scene has light of its own, else the sky
        map,        // an equirectangular picture
        background, // the same radiance from everywhere
        sky,        // clear, with its sun
    };

    Kind kind = Kind::automatic;
    std::filesystem::path map;
    float rotation = 0.0f;  // radians; turns the map around y, from +z towards +x
    float intensity = 1.0f; // multiplies the radiance of map and sky, at least 0
    glm::vec3 background{0.0f};
    float sunElevation = 0.785398163f; // SkySettings'
    float sunAzimuth = 0.0f;

    bool operator==(const LightChoice&) const = default;
};

} // namespace metamarch
