// SPDX-License-Identifier: MIT
// Converts an integrator's film to a picture.
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/image/image.h"

#include <span>

namespace metamarch {

// `film` has width * height pixels, and the parts that `written` needs. `seen` has a point for each pixel, or
// none where `written` needs none. The picture gets the channels of `written` but Cryptomatte;
// `missDepth` is what Z and t are where there is nothing. Throws std::invalid_argument for a film of another
// size.
Image filmImage(const FilmData& film, std::span<const SeenPoint> seen, int width, int height,
                std::span<const Aov> written, float missDepth = std::numeric_limits<float>::infinity());

} // namespace metamarch
