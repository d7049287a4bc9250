// SPDX-License-Identifier: MIT
// Materials that each show one part of the BSDF, and some that combine several.
#pragma once
#include "metamarch/shared/bsdf.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace metamarch {

struct Look {
    std::string name;
    SurfaceMaterial material;
};

inline constexpr int kLooks = 21;
std::vector<Look> looks(); // kLooks of them

std::string nameOf(const testing::TestParamInfo<Look>& info);
std::ostream& operator<<(std::ostream& stream, const Look& look);

// Returns a direction at this cosine to the z axis, in a plane oblique to the x and y axes.
vec3 directionOf(float cosine);

// The front faces z; the shading normal is tilted by the tangent `tilt`, the coat's normal by half of that.
SurfaceFrame tiltedFrame(vec3 wo, float tilt);

} // namespace metamarch
