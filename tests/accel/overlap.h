// SPDX-License-Identifier: MIT
// A triangle-box overlap test that does not share the builder's method; it checks clipping and leaves.
#pragma once
#include "metamarch/accel/triangle_clip.h"

#include <glm/glm.hpp>

namespace metamarch::tests {

struct Box {
    glm::dvec3 lo;
    glm::dvec3 hi;
};

// Returns true if the triangle, which may be degenerate, and the closed box share a point. T. Akenine-Möller,
// "Fast 3D Triangle-Box Overlap Testing", Journal of Graphics Tools 6(1), 2001: separating axes, here in long
// double.
bool overlaps(const LatticeTriangle& triangle, const Box& box);

// Returns the box of cells lo..hi (inclusive), grown by `margin` on every side.
Box grown(const CellRange& cells, const glm::dvec3& margin);

// Tolerance for the rounding errors of builder and test, as a fraction of the margin. A triangle must be
// found if it meets a box that is grown by a margin smaller by this. It must not be found if it does not even
// meet a box that is grown by a margin larger by this.
inline constexpr double kMarginRounding = 0x1p-16;

} // namespace metamarch::tests
