// Materials, frames and directions of every kind.
#pragma once
#include "bsdf_case.h"

#include <cstddef>
#include <vector>

namespace metamarch {

// The defaults of glTF 2.0 and its extensions.
SurfaceMaterial plainMaterial();

// Each parameter off, at one end of its range or anywhere in it; normals that disagree; directions on both
// sides.
std::vector<BsdfCase> randomBsdfCases(std::size_t count);

} // namespace metamarch
