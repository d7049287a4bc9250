// SPDX-License-Identifier: MIT
#include "metamarch/accel/triangle_box.h"

#include "metamarch/accel/lattice.h"

#include <cmath>

namespace metamarch {
namespace {

// Return the nearest float that is not above (below) x.
float roundDown(const double x) {
    const auto rounded = static_cast<float>(x);
    return rounded > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}
float roundUp(const double x) { return -roundDown(-x); }

} // namespace

Box boxOf(const Lattice& lattice, const TriangleRecord& triangle) {
    const glm::dvec3 margin = kBoxMargin / kReferenceMargin * referenceMargin(lattice);
    const glm::dvec3 a = toLattice(lattice, triangle.v0);
    const glm::dvec3 b = toLattice(lattice, triangle.v1);
    const glm::dvec3 c = toLattice(lattice, triangle.v2);
    return {glm::min(glm::min(a, b), c) - margin, glm::max(glm::max(a, b), c) + margin};
}

vec3 lowCorner(const Box& box) { return {roundDown(box.lo.x), roundDown(box.lo.y), roundDown(box.lo.z)}; }
vec3 highCorner(const Box& box) { return {roundUp(box.hi.x), roundUp(box.hi.y), roundUp(box.hi.z)}; }

} // namespace metamarch
