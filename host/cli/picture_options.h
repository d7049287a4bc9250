// SPDX-License-Identifier: MIT
// What the user chooses for a picture of a scene, in a file or in a window.
#pragma once
#include "metamarch/settings/render_settings.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace metamarch::cli {

struct PictureOptions {
    explicit PictureOptions(const std::uint32_t samples) : samplesPerPixel(samples) {}

    std::string scenePath;
    ImportOptions import;
    AccelerationOptions structure;
    ViewChoice view;
    glm::uvec2 size{1280, 720};
    PathChoice path;
    std::uint32_t samplesPerPixel;
    LightChoice light;
    ToneMapping tone{kToneNeutral};
    std::string device;
    std::string traversal; // empty: what marches the table
    std::optional<std::uint32_t> threads;
};

} // namespace metamarch::cli
