// WebP, by libwebp itself: OpenImageIO 2.4 multiplies a WebP's colours by their alpha, and what that rounds
// away is gone.
#pragma once
#include "metamarch/scene/texture.h"

#include <span>

namespace metamarch {

// Throws TextureFailure, also where metamarch was built without libwebp.
TextureImage decodeWebp(std::span<const unsigned char> bytes);

} // namespace metamarch
