// Light from all around: an equirectangular picture.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace metamarch {

// Linear radiance, finite and not negative. Row 0 is the top one (+y); what an OpenImageIO format has encoded
// has been decoded from sRGB.
struct Environment {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::vec3> texels;
};

// Reads any picture that OpenImageIO knows; alpha and further channels are left out, grey is spread. Throws
// Error(sceneRefused), one line that names file and, where one is at fault, texel.
Environment loadEnvironment(const std::filesystem::path& file);

} // namespace metamarch
