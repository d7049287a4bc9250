// SPDX-License-Identifier: MIT
// Light from all directions, as an equirectangular image.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// Linear radiance, finite and not negative. Row 0 is the top row (+y). Colours of formats that OpenImageIO
// treats as sRGB-encoded have been decoded.
struct Environment {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels;
    std::vector<std::string> warnings; // one line each, for the user
};

// Reads any image that readImage reads. Alpha and further channels are ignored; grey is copied to all
// colours. With `maximum`, which is above 0, brighter texels are scaled until their largest channel is
// `maximum`. Channels become, each with a warning that names the number of texels:
// - `maximum` if they are infinite, or without it 65504, the largest half float, or the brightest channel of
//   the map if that is more;
// - 0 if they are no number;
// - 0 if they are negative and the colour lies outside Rec. 709, or if a filter that scaled the image
//   undershot beside brighter light.
// Throws Error(inputRefused), naming the file and the texel, for other negative light.
Environment loadEnvironment(const std::filesystem::path& file, std::optional<float> maximum = {});

} // namespace metamarch
