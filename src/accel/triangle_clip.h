// Which cells a triangle touches inside a box of cells, never one too few.
#pragma once
#include "metamarch/accel/triangle_box.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace metamarch {

using CellCorner = std::array<std::uint16_t, 3>;

// Cells lo..hi, both inclusive.
struct CellRange {
    CellCorner lo;
    CellCorner hi;
};

using LatticeTriangle = std::array<glm::dvec3, 3>; // corners in lattice space

// The smallest box around what of the triangle lies in `box`, or nothing when nothing does. I. E. Sutherland,
// G. W. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974, in double precision.
std::optional<Box> clipTriangle(const LatticeTriangle& triangle, const Box& box);

// The range of cells in the box lo..hi (inclusive) that come within `margin` (cells per axis) of the
// triangle, or nothing when none does: clipped against the box grown by the margin, of which the roundings
// are 2^-29.
std::optional<CellRange> touchedCells(const LatticeTriangle& triangle, const CellRange& box,
                                      const glm::dvec3& margin);

// Cells of one row along x.
struct RowOfCells {
    std::uint16_t x;
    std::uint16_t endX; // exclusive
    std::uint16_t y;
    std::uint16_t z;
};

// All cells of a lattice that come within `margin` of the triangle, which lies inside; rows ascend by z, then
// y.
std::vector<RowOfCells> touchedRows(const LatticeTriangle& triangle, glm::uvec3 resolution,
                                    const glm::dvec3& margin);

} // namespace metamarch
