// SPDX-License-Identifier: MIT
// Light from all directions, as an equirectangular image.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
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

// Reads any image that OpenImageIO supports. Alpha and further channels are ignored; grey is copied to all
// colours. Negative channels become 0, with a warning, if the colour lies outside Rec. 709 or if a filter
// that scaled the image undershot beside brighter light. Throws Error(inputRefused), naming the file and, if
// one is at fault, the texel, for other negative light and for numbers that are not finite.
Environment loadEnvironment(const std::filesystem::path& file);

} // namespace metamarch
