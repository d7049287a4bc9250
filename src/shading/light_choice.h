// SPDX-License-Identifier: MIT
// The user's choice of light that does not come from the scene's file.
#pragma once
#include <glm/glm.hpp>

#include <filesystem>
#include <optional>

namespace metamarch {

struct LightChoice {
    enum class Kind {
        automatic,  // no light if the scene has its own, otherwise the sky
        map,        // an equirectangular picture
        background, // the same radiance from all directions
        sky,        // a clear sky with its sun
    };

    Kind kind = Kind::automatic;
    std::filesystem::path map;
    float rotation = 0.0f;             // radians; turns the map around y, from +z towards +x
    float intensity = 1.0f;            // factor of the radiance of map and sky, at least 0
    std::optional<float> mapMaximum{}; // the largest radiance of the map in any channel, above 0
    glm::vec3 background{0.0f};
    float sunElevation = 0.785398163f; // as in SkySettings
    float sunAzimuth = 0.0f;

    bool operator==(const LightChoice&) const = default;
};

} // namespace metamarch
