// SPDX-License-Identifier: MIT
// Random materials, frames and directions of every kind.
#pragma once
#include "bsdf_case.h"

#include <cstddef>
#include <vector>

namespace metamarch {

// Returns the defaults of glTF 2.0 and its extensions.
SurfaceMaterial plainMaterial();

// Each parameter is off, at an end of its range or anywhere within it. Normals may disagree, and directions
// lie on both sides.
std::vector<BsdfCase> randomBsdfCases(std::size_t count);

} // namespace metamarch
