// SPDX-License-Identifier: MIT
// Finds the cells that a triangle touches inside a box of cells; it never misses one.
#pragma once
#include "metamarch/accel/triangle_box.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace metamarch {

using CellCorner = std::array<std::uint16_t, 3>;

// A range of cells; both ends are inclusive.
struct CellRange {
    CellCorner lo;
    CellCorner hi;
};

using LatticeTriangle = std::array<glm::dvec3, 3>; // corners in lattice space

// Returns the smallest box around the part of the triangle that lies in `box`, or nothing if there is no such
// part. I. E. Sutherland, G. W. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974, in double precision.
std::optional<Box> clipTriangle(const LatticeTriangle& triangle, const Box& box);

// Returns the range of cells in `box` that come within `margin` (in cells, per axis) of the triangle, or
// nothing if there are none. The triangle is clipped against the box grown by the margin; the rounding errors
// are 2^-29 of the margin.
std::optional<CellRange> touchedCells(const LatticeTriangle& triangle, const CellRange& box,
                                      const glm::dvec3& margin);

// A run of cells along x.
struct RowOfCells {
    std::uint16_t x;
    std::uint16_t endX; // exclusive
    std::uint16_t y;
    std::uint16_t z;
};

// Returns all cells of a lattice that come within `margin` (in cells, per axis) of the triangle, which must
// lie inside the lattice. Rows ascend by z, then y.
std::vector<RowOfCells> touchedRows(const LatticeTriangle& triangle, glm::uvec3 resolution,
                                    const glm::dvec3& margin);

} // namespace metamarch
