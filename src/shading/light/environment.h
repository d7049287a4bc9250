// Light from all around: an equirectangular picture.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace metamarch {

// Linear radiance, finite and not negative. Row 0 is the top one (+y); what an OpenImageIO format has encoded
// has been decoded from sRGB.
struct Environment {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels;
    std::vector<std::string> warnings; // one line each, for the user
};

// Reads any picture that OpenImageIO knows; alpha and further channels are left out, grey is spread. Negative
// channels become 0, with a warning, in colours outside Rec. 709 and where a filter that scaled the picture
// undershot beside brighter light. Throws Error(inputRefused), one line that names file and, where one is at
// fault, texel: other negative light, and numbers that are not finite.
Environment loadEnvironment(const std::filesystem::path& file);

} // namespace metamarch
