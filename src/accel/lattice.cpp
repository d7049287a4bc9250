// SPDX-License-Identifier: MIT
#include "metamarch/accel/lattice.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamarch {
namespace {

// Limits of the scene's extent. Beyond them, products of three lengths underflow or overflow in single
// precision.
constexpr double kMinExtent = 1e-10;
constexpr double kMaxExtent = 1e10;

// Tolerance for units given in single precision: 0.3f / 0.1 is 3.00000004 and means 3 cells.
constexpr double kUnitRounding = 0x1p-22;

// Chosen by measurement: MEASURED.md in this folder.
constexpr double kCellsPerTriangle = 2.5;
constexpr double kMinCells = 4096.0;

// Largest cell size, in typical edges. It matters where a model stands on a floor: kCellsPerTriangle would
// leave the model a handful of cells. Closed models on their own get about equally fine cells from
// kCellsPerTriangle. Chosen by measurement: MEASURED.md in this folder.
constexpr double kCellPerEdge = 1.5;

// Smallest cell size for typical edges, as a fraction of the longest side. Smaller cells would list triangles
// only because of their margins.
constexpr double kLeastCell = 4.0 * kReferenceMargin;

constexpr double kTooManyCells =
    1.0 + 1.0 * kMaxLatticeResolution * kMaxLatticeResolution * kMaxLatticeResolution;

// Default quantum of method 2, as a fraction of the longest side. It gives at most 2^24 cells, whatever the
// divisors are.
constexpr double kDefaultQuantum = 0x1p-8;

// More quanta on a side would be smaller than the margin of the references.
constexpr double kMostQuanta = 1.0 / kReferenceMargin;

glm::dvec3 cellCounts(const glm::dvec3 extent, const glm::dvec3 unit) {
    return glm::max(glm::ceil(extent / unit * (1.0 - kUnitRounding)), glm::dvec3(1.0));
}

double largestOf(const glm::dvec3 v) { return std::max({v.x, v.y, v.z}); }
double product(const glm::dvec3 v) { return v.x * v.y * v.z; }

// Finds by bisection the smallest cubic unit that gives at most `cells` cells in all and
// kMaxLatticeResolution on an axis.
glm::dvec3 unitForCells(const glm::dvec3 extent, const double cells) {
    const double longest = largestOf(extent);
    double tooSmall = longest / kMaxLatticeResolution * 0.5;
    double fits = longest;
    for (int i = 0; i < 60; ++i) {
        const double unit = 0.5 * (tooSmall + fits);
        const glm::dvec3 counts = cellCounts(extent, glm::dvec3(unit));
        const bool fitsAxis = largestOf(counts) <= kMaxLatticeResolution;
        (fitsAxis && product(counts) <= cells ? fits : tooSmall) = unit;
    }
    return glm::dvec3(fits);
}

// A number printed with six digits may be too small by this factor.
constexpr double kDigitsRounding = 1.0 + 5e-6;

void refuseOverLimit(const glm::dvec3 counts, const double longestSide) {
    if (largestOf(counts) > kMaxLatticeResolution) {
        throw Error(
            ErrorKind::outOfMemory,
            fmt::format(
                "the unit length asks for {:.0f} x {:.0f} x {:.0f} cells, and a lattice has at most {} "
                "on an axis; choose a unit of at least {:.6g}",
                counts.x, counts.y, counts.z, kMaxLatticeResolution,
                longestSide / kMaxLatticeResolution * kDigitsRounding));
    }
}

// The box that the lattice covers: the scene's bounds, or a unit cube if the scene has no triangles.
struct Extents {
    glm::dvec3 lo;
    glm::dvec3 hi;
    glm::dvec3 size;
    double longest;
};

Extents extentsOf(const Bounds& bounds, const std::uint32_t triangleCount) {
    const bool empty = triangleCount == 0;
    Extents extents;
    extents.lo = empty ? glm::dvec3(0.0) : glm::dvec3(bounds.lo);
    extents.hi = empty ? glm::dvec3(1.0) : glm::dvec3(bounds.hi);
    extents.size = extents.hi - extents.lo;
    extents.longest = largestOf(extents.size);
    if (extents.longest < kMinExtent || extents.longest > kMaxExtent) {
        throw Error(
            ErrorKind::inputRefused,
            fmt::format(
                "the scene's longest side is {:.3g}, and single precision needs {:g} to {:g}; scale it",
                extents.longest, kMinExtent, kMaxExtent),
            {"scale"});
    }
    return extents;
}

// Returns the unit if the user gives none. Each axis on its own has at most kMaxLatticeResolution cells,
// which keeps cells larger than the margin.
glm::dvec3 automaticUnit(const glm::dvec3& size, const std::uint32_t triangleCount,
                         const double typicalEdge) {
    const glm::dvec3 forCount =
        unitForCells(size, std::clamp(kCellsPerTriangle * triangleCount, kMinCells, kMostAutomaticCells));
    const double side = std::max(kCellPerEdge * typicalEdge, kLeastCell * largestOf(size));
    const glm::dvec3 forSize = glm::max(glm::dvec3(side), size / static_cast<double>(kMaxLatticeResolution));
    return typicalEdge > 0.0 ? glm::min(forCount, forSize) : forCount;
}

// Makes the lattice of `counts` cells, with the box in its middle. The padding is relative to `longest` or to
// the lattice's side, whichever is longer. The rounded origin and scale define the lattice; everything else
// is derived from them.
Lattice place(const Extents& box, const glm::dvec3& unit, const glm::dvec3& counts, const double longest) {
    Lattice lattice;
    lattice.resolution = glm::uvec3(counts);
    lattice.cellCount = lattice.resolution.x * lattice.resolution.y * lattice.resolution.z;
    lattice.extent = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = std::max(unit[axis] * counts[axis], box.size[axis]);
        // Far from the world's origin, the padding must also cover the rounding of positions.
        const double farthest = std::max(std::abs(box.lo[axis]), std::abs(box.hi[axis]));
        const double padding = kBoxPadding * std::max(side, longest) + 4.0 * farthest * 0x1p-24;
        const double slack = std::max(side - box.size[axis], 2.0 * padding);
        lattice.origin[axis] = static_cast<float>(box.lo[axis] - 0.5 * slack);
        const double reach = box.hi[axis] + 0.5 * slack - static_cast<double>(lattice.origin[axis]);
        lattice.cellsPerUnit[axis] = static_cast<float>(counts[axis] / reach);
        lattice.extent = std::max(lattice.extent, static_cast<float>(reach));
    }
    return lattice;
}

} // namespace

LatticeChoice makeLattice(const Bounds& bounds, const std::uint32_t triangleCount,
                          const AccelerationOptions& options, const double typicalEdge) {
    const Extents extents = extentsOf(bounds, triangleCount);
    LatticeChoice choice;
    if (options.partition) {
        choice.unit = extents.size / glm::dvec3(options.partition->resolution);
    } else if (triangleCount == 0) {
        choice.unit = extents.size; // one empty cell
    } else if (options.unit) {
        choice.unit = *options.unit;
    } else if (options.cells) {
        const double cells = static_cast<double>(*options.cells);
        if (cells >= kTooManyCells) {
            throw Error(ErrorKind::outOfMemory,
                        fmt::format("a lattice of {:.0f} cells has more than {} on an axis; choose fewer "
                                    "than {:.0f}",
                                    cells, kMaxLatticeResolution, kTooManyCells),
                        {"cells"});
        }
        choice.unit = unitForCells(extents.size, cells);
    } else {
        choice.unit = automaticUnit(extents.size, triangleCount, typicalEdge);
    }
    const glm::dvec3 counts =
        options.partition ? glm::dvec3(options.partition->resolution) : cellCounts(extents.size, choice.unit);
    refuseOverLimit(counts, extents.longest);

    choice.lattice = place(extents, choice.unit, counts, extents.longest);
    choice.lattice.triangleCount = triangleCount;
    return choice;
}

LatticeChoice makeQuantumLattice(const Bounds& bounds, const std::uint32_t triangleCount,
                                 const std::optional<double> quantum) {
    const Extents extents = extentsOf(bounds, triangleCount);
    const double side = quantum.value_or(kDefaultQuantum * extents.longest);
    LatticeChoice choice;
    choice.unit = glm::dvec3(side);
    const glm::dvec3 counts = cellCounts(extents.size, choice.unit);
    if (largestOf(counts) > kMostQuanta) {
        throw Error(
            ErrorKind::invalidArgument,
            fmt::format(
                "a quantum of {:g} is finer than single precision; give at least {:.6g} for this scene", side,
                extents.longest / kMostQuanta * kDigitsRounding),
            {"quantum"});
    }
    // The last cell consists of several quanta and may stick out by nearly the whole side again.
    choice.lattice = place(extents, choice.unit, counts, 2.0 * extents.longest);
    choice.lattice.triangleCount = triangleCount;
    return choice;
}

glm::dvec3 toLattice(const Lattice& lattice, const glm::vec3 position) {
    return (glm::dvec3(position) - glm::dvec3(lattice.origin)) * glm::dvec3(lattice.cellsPerUnit);
}

glm::dvec3 toWorld(const Lattice& lattice, const glm::dvec3 position) {
    return glm::dvec3(lattice.origin) + position / glm::dvec3(lattice.cellsPerUnit);
}

Bounds worldBox(const Lattice& lattice, const CellBox& box) {
    return {glm::vec3(toWorld(lattice, glm::dvec3(box.lo))), glm::vec3(toWorld(lattice, glm::dvec3(box.hi)))};
}

glm::dvec3 referenceMargin(const Lattice& lattice) {
    return kReferenceMargin * static_cast<double>(lattice.extent) * glm::dvec3(lattice.cellsPerUnit);
}

} // namespace metamarch
