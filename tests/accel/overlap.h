// Whether a triangle meets a box, by another method than the builder's: the judge of clipping and of leaves.
#pragma once
#include "metamarch/accel/triangle_clip.h"

#include <glm/glm.hpp>

namespace metamarch::tests {

struct Box {
    glm::dvec3 lo;
    glm::dvec3 hi;
};

// Whether the triangle, which may be degenerate, and the closed box have a point in common. T.
// Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing", Journal of Graphics Tools 6(1), 2001: separating
// axes, here in long double.
bool overlaps(const LatticeTriangle& triangle, const Box& box);

// The cells lo..hi (inclusive), grown by `margin` on every side.
Box grown(const CellRange& cells, const glm::dvec3& margin);

// Room for the roundings of builder and judge, as a fraction of the margin: what meets a box grown by a
// margin smaller by this must be found, what does not meet one larger by it must not.
inline constexpr double kMarginRounding = 0x1p-16;

} // namespace metamarch::tests
