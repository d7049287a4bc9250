// The uniform lattice that every split plane and every table cell lies on.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/accel/options.h"
#include "metamarch/geometry/triangle_mesh.h"
#include "metamarch/shared/scene_layout.h"

namespace metamarch {

// Every triangle is listed in each leaf that comes this near to it, as a fraction of the lattice's longest
// side: 64 half-ulps. README.md in this folder adds up the roundings it has to cover.
inline constexpr double kReferenceMargin = 0x1p-18;

// The lattice keeps geometry this far inside, in the same measure.
inline constexpr double kBoxPadding = 2.0 * kReferenceMargin;

// Bytes that the table may take.
inline constexpr std::uint64_t kTableBudget = std::uint64_t{1} << 30;

// The same where no cells are asked for: less than the 128 MiB that storage buffers must be able to hold.
inline constexpr std::uint64_t kAutomaticTableBudget = std::uint64_t{96} << 20;

// Cells that are chosen at most by the count of triangles, and by the planes of a tree.
inline constexpr double kMostAutomaticCells = 0x1p24;

struct LatticeChoice {
    Lattice lattice;
    glm::dvec3 unit; // the unit lengths asked for or chosen; the cells are up to about 1e-5 larger where
                     // ceil(extent / unit) cells of it would leave no padding
};

// The lattice over `bounds` for `triangleCount` triangles. Method 1 of the paper: the unit first, and
// ceil(extent / unit) cells an axis. Without unit and cells, kCellsPerTriangle decides; a partition brings
// its own resolution. `typicalEdge`: the median of the triangles' longest edges, 0 where it does not matter;
// small triangles in a large box get more cells for it, up to kMaxLatticeResolution on each axis. Throws
// Error(inputRefused) for a scene too small or too large for single precision and Error(outOfMemory) for more
// than kMaxLatticeResolution cells on an axis.
LatticeChoice makeLattice(const Bounds& bounds, std::uint32_t triangleCount,
                          const AccelerationOptions& options, double typicalEdge = 0.0);

// Method 2 of the paper, first half: the lattice of quanta that planes are rounded to, which no table is made
// of. `quantum` is in scene units; kDefaultQuantum of the longest side decides without. Throws
// Error(inputRefused) as makeLattice, and Error(invalidArgument) for a quantum below kReferenceMargin of the
// longest side.
LatticeChoice makeQuantumLattice(const Bounds& bounds, std::uint32_t triangleCount,
                                 std::optional<double> quantum);

// World to lattice space, in double precision: exactly the map that the shaders round.
glm::dvec3 toLattice(const Lattice& lattice, glm::vec3 position);

// And back, by the same map.
glm::dvec3 toWorld(const Lattice& lattice, glm::dvec3 position);

// A box of cells in world space, rounded to single precision: what it looks like, not what the march computes
// with.
Bounds worldBox(const Lattice& lattice, const CellBox& box);

// kReferenceMargin in cells.
glm::dvec3 referenceMargin(const Lattice& lattice);

} // namespace metamarch
