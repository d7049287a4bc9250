// Encoded pictures in memory to texels.
#pragma once
#include "metamarch/scene/texture.h"

#include <span>
#include <stdexcept>
#include <string>

namespace metamarch {

// Why a texture cannot be had, without its name: "is missing".
class TextureFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct DecodedTexture {
    TextureImage image;    // its name is left empty
    bool isLinear = false; // of a format that never encodes colours: OpenEXR, Radiance HDR
};

// Reads PNG, JPEG, WebP, OpenEXR, Radiance HDR, TIFF, BMP and GIF, known by their first bytes, and TGA, which
// is known by nothing: it is tried for `ending` ".tga". Throws TextureFailure for anything else, for a
// picture that is cut off, not finite or too large. May run on several threads at once.
DecodedTexture decodeTexture(std::span<const unsigned char> bytes, const std::string& ending);

} // namespace metamarch
