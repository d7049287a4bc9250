// SPDX-License-Identifier: MIT
// Decodes images in memory to texels.
#pragma once
#include "metamarch/scene/texture.h"

#include <span>
#include <stdexcept>
#include <string>

namespace metamarch {

// The reason why a texture is unavailable, without the texture's name: "is missing".
class TextureFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct DecodedTexture {
    TextureImage image;    // the name is left empty
    bool isLinear = false; // true for formats that never encode colours: OpenEXR, Radiance HDR
    // What is wrong with the file although all texels are there, without the texture's name: "has no end
    // mark". Empty if nothing is.
    std::string flaw{};
};

// Decodes PNG, JPEG, WebP, OpenEXR, Radiance HDR, TIFF, BMP and GIF, recognised by their first bytes. TGA has
// no signature; it is tried if `ending` is ".tga". Throws TextureFailure for any other format and for a
// picture that is truncated, not finite or too large. May run on several threads at once.
DecodedTexture decodeTexture(std::span<const unsigned char> bytes, const std::string& ending);

} // namespace metamarch
