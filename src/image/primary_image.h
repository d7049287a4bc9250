// The `primary` integrator's pixels as a picture.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/shared/primary.h"

#include <span>

namespace metamarch {

// Channels R G B A, Z, t, N.X N.Y N.Z, id.triangle, steps, tests. A miss has A = 0, id.triangle = -1 and
// Z = t = +infinity. Ids are exact up to 2^24, the integers that a 32-bit float holds.
Image primaryImage(std::span<const PrimaryPixel> pixels, int width, int height);

} // namespace metamarch
