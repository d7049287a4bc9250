// SPDX-License-Identifier: MIT
// Decodes WebP with libwebp directly: OpenImageIO 2.4 premultiplies a WebP's colours by alpha, and the
// precision that this rounds away is lost.
#pragma once
#include "metamarch/scene/texture.h"

#include <span>

namespace metamarch {

// Throws TextureFailure, also if metamarch was built without libwebp.
TextureImage decodeWebp(std::span<const unsigned char> bytes);

} // namespace metamarch
