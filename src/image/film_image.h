// SPDX-License-Identifier: MIT
// Converts an integrator's film to a picture.
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/image/image.h"

#include <span>

namespace metamarch {

// `film` has width * height pixels in rows from the top. The picture gets the channels of `written`.
Image filmImage(std::span<const FilmPixel> film, int width, int height, std::span<const Aov> written);

} // namespace metamarch
