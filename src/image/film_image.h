// The path tracer's film as a picture.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/shared/film.h"

#include <span>

namespace metamarch {

// Channels R G B A, Z, t, N.X N.Y N.Z (geometric), Ns.X Ns.Y Ns.Z (shading), albedo.R albedo.G albedo.B,
// variance.R variance.G variance.B (of R, G and B as means of independent samples; stratified ones are
// better), id.triangle, steps, tests (a sample). All are means over the pixel's samples, but that Z, t and
// id.triangle are the first sample's. Where that meets nothing, id.triangle = -1 and Z = t = +infinity.
Image filmImage(std::span<const FilmPixel> film, int width, int height);

} // namespace metamarch
