// Materials that each show one part of the BSDF, and some that mix them.
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

// In a plane askew to the axes, at this cosine to the z axis.
vec3 directionOf(float cosine);

// The front looks along z; the shading normal leans by the tangent `tilt`, the coat's by half of that.
SurfaceFrame tiltedFrame(vec3 wo, float tilt);

} // namespace metamarch
