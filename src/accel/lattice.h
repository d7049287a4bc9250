// SPDX-License-Identifier: MIT
// The uniform lattice on which all split planes and table cells lie.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/options.h"
#include "metamarch/geometry/triangle_mesh.h"
#include "metamarch/shared/scene_layout.h"

namespace metamarch {

// A leaf lists every triangle that comes within this distance of it, as a fraction of the lattice's longest
// side: 64 half-ulps. src/accel/README.md adds up the rounding errors that it must cover.
inline constexpr double kReferenceMargin = 0x1p-18;

// The box of a reference is larger by this than the triangle's part, and a box of a hierarchy than the
// triangle, as a fraction of the longest side: 88 half-ulps. The roundings of a box's own planes come to
// those that kReferenceMargin covers.
inline constexpr double kBoxMargin = 88.0 * 0x1p-24;

// Geometry keeps this distance from the faces of the lattice, as a fraction of its longest side.
inline constexpr double kBoxPadding = 2.0 * kReferenceMargin;

// The largest table, in bytes.
inline constexpr std::uint64_t kTableBudget = std::uint64_t{1} << 30;

// The largest table, in bytes, if the user asks for no number of cells. It is below 128 MiB, the size that
// every device must support for a storage buffer.
inline constexpr std::uint64_t kAutomaticTableBudget = std::uint64_t{96} << 20;

// The largest number of cells that is chosen from the triangle count or from the planes of a tree.
inline constexpr double kMostAutomaticCells = 0x1p24;

struct LatticeChoice {
    Lattice lattice;
    // The unit length requested or chosen, per axis; cells are up to about 1e-5 larger where ceil(extent /
    // unit) cells of this size would leave no padding.
    glm::dvec3 unit;
};

// Chooses the lattice over `bounds` for `triangleCount` triangles. Method 1 of the paper: first the unit
// length, then ceil(extent / unit) cells per axis. If the options give neither unit nor cells,
// kCellsPerTriangle decides; a partition brings its own resolution. `typicalEdge` is the median of the
// triangles' longest edges, or 0 to ignore it; small triangles in a large box get more cells for it, up to
// kMaxLatticeResolution per axis. Throws Error(inputRefused) for a scene too small or too large for single
// precision, and Error(outOfMemory) for more than kMaxLatticeResolution cells on an axis.
LatticeChoice makeLattice(const Bounds& bounds, std::uint32_t triangleCount,
                          const AccelerationOptions& options, double typicalEdge = 0.0);

// First half of method 2 of the paper: makes the lattice of quanta to which planes are rounded. No table is
// built over it. `quantum` is in scene units; without it, kDefaultQuantum times the longest side is used.
// Throws Error(inputRefused) like makeLattice, and Error(invalidArgument) if the quantum is below
// kReferenceMargin times the longest side.
LatticeChoice makeQuantumLattice(const Bounds& bounds, std::uint32_t triangleCount,
                                 std::optional<double> quantum);

// Maps world space to lattice space in double precision: the exact map that the shaders round.
glm::dvec3 toLattice(const Lattice& lattice, glm::vec3 position);

// The inverse of toLattice.
glm::dvec3 toWorld(const Lattice& lattice, glm::dvec3 position);

// Returns a box of cells in world space, rounded to single precision. It is for display; the march does not
// compute with it.
Bounds worldBox(const Lattice& lattice, const CellBox& box);

// Returns kReferenceMargin in cells, per axis.
glm::dvec3 referenceMargin(const Lattice& lattice);

} // namespace metamarch
