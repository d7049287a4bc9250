#include "accel/lattice.h"

#include "error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamarch {
namespace {

// Extents outside these lose products of three lengths to underflow or overflow in single precision.
constexpr double kMinExtent = 1e-10;
constexpr double kMaxExtent = 1e10;

// Positions are single precision: 0.3f / 0.1 is 3.00000004 and means 3 cells.
constexpr double kUnitRounding = 0x1p-22;

// Chosen by measurement: README.md in this folder.
constexpr double kCellsPerTriangle = 8.0;
constexpr double kMinCells = 4096.0;
constexpr double kMaxCells = 0x1p24;

glm::dvec3 cellCounts(const glm::dvec3 extent, const glm::dvec3 unit) {
    return glm::max(glm::ceil(extent / unit * (1.0 - kUnitRounding)), glm::dvec3(1.0));
}

double product(const glm::dvec3 v) { return v.x * v.y * v.z; }

// The smallest cubic unit with at most `cells` cells in all and kMaxLatticeResolution on an axis, by
// bisection.
glm::dvec3 unitForCells(const glm::dvec3 extent, const double cells) {
    const double longest = std::max({extent.x, extent.y, extent.z});
    double tooSmall = longest / kMaxLatticeResolution * 0.5;
    double fits = longest;
    for (int i = 0; i < 60; ++i) {
        const double unit = 0.5 * (tooSmall + fits);
        const glm::dvec3 counts = cellCounts(extent, glm::dvec3(unit));
        const bool fitsAxis = std::max({counts.x, counts.y, counts.z}) <= kMaxLatticeResolution;
        (fitsAxis && product(counts) <= cells ? fits : tooSmall) = unit;
    }
    return glm::dvec3(fits);
}

// A number printed with six digits may be this much too small.
constexpr double kDigitsRounding = 1.0 + 5e-6;

void refuseOverLimit(const glm::dvec3 counts, const glm::dvec3 extent) {
    const double longest = std::max({counts.x, counts.y, counts.z});
    if (longest > kMaxLatticeResolution) {
        throw Error(
            ExitCode::outOfMemory,
            fmt::format(
                "the unit length asks for {:.0f} x {:.0f} x {:.0f} cells, and a lattice has at most {} "
                "on an axis; choose a unit of at least {:.6g}",
                counts.x, counts.y, counts.z, kMaxLatticeResolution,
                std::max({extent.x, extent.y, extent.z}) / kMaxLatticeResolution * kDigitsRounding));
    }
    const double bytes = product(counts) * sizeof(std::uint32_t);
    if (bytes > static_cast<double>(kTableBudget)) {
        throw Error(
            ExitCode::outOfMemory,
            fmt::format(
                "a meta table of {:.0f} x {:.0f} x {:.0f} cells takes {:.0f} MiB, more than the {} MiB "
                "allowed; choose a larger --unit or --cells below {}",
                counts.x, counts.y, counts.z, bytes / 0x1p20, kTableBudget >> 20u,
                kTableBudget / sizeof(std::uint32_t)));
    }
}

} // namespace

LatticeChoice makeLattice(const Bounds& bounds, const std::uint32_t triangleCount,
                          const AccelerationOptions& options) {
    // A scene without triangles has one empty cell.
    const bool empty = triangleCount == 0;
    const glm::dvec3 lo = empty ? glm::dvec3(0.0) : glm::dvec3(bounds.lo);
    const glm::dvec3 hi = empty ? glm::dvec3(1.0) : glm::dvec3(bounds.hi);
    const glm::dvec3 extent = hi - lo;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (longest < kMinExtent || longest > kMaxExtent) {
        throw Error(
            ExitCode::sceneRefused,
            fmt::format(
                "the scene's longest side is {:.3g}, and single precision needs {:g} to {:g}; use --scale",
                longest, kMinExtent, kMaxExtent));
    }

    LatticeChoice choice;
    if (options.partition) {
        choice.unit = extent / glm::dvec3(options.partition->resolution);
    } else if (empty) {
        choice.unit = extent;
    } else if (options.unit) {
        choice.unit = *options.unit;
    } else {
        const double automatic = std::clamp(kCellsPerTriangle * triangleCount, kMinCells, kMaxCells);
        const double cells = options.cells ? static_cast<double>(*options.cells) : automatic;
        if (cells * sizeof(std::uint32_t) > static_cast<double>(kTableBudget)) {
            throw Error(
                ExitCode::outOfMemory,
                fmt::format(
                    "a meta table of {:.0f} cells takes {:.0f} MiB, more than the {} MiB allowed; choose "
                    "--cells below {}",
                    cells, cells * sizeof(std::uint32_t) / 0x1p20, kTableBudget >> 20u,
                    kTableBudget / sizeof(std::uint32_t)));
        }
        choice.unit = unitForCells(extent, cells);
    }
    const glm::dvec3 counts =
        options.partition ? glm::dvec3(options.partition->resolution) : cellCounts(extent, choice.unit);
    refuseOverLimit(counts, extent);

    // The rounded origin and scale are the lattice; everything else follows them. Far from the world's origin
    // the padding must also cover the rounding of positions.
    Lattice& lattice = choice.lattice;
    lattice.resolution = glm::uvec3(counts);
    lattice.cellCount = lattice.resolution.x * lattice.resolution.y * lattice.resolution.z;
    lattice.triangleCount = triangleCount;
    lattice.extent = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = std::max(choice.unit[axis] * counts[axis], extent[axis]);
        const double farthest = std::max(std::abs(lo[axis]), std::abs(hi[axis]));
        const double padding = kBoxPadding * std::max(side, longest) + 4.0 * farthest * 0x1p-24;
        const double slack = std::max(side - extent[axis], 2.0 * padding);
        lattice.origin[axis] = static_cast<float>(lo[axis] - 0.5 * slack);
        const double reach = hi[axis] + 0.5 * slack - static_cast<double>(lattice.origin[axis]);
        lattice.cellsPerUnit[axis] = static_cast<float>(counts[axis] / reach);
        lattice.extent = std::max(lattice.extent, static_cast<float>(reach));
    }
    return choice;
}

glm::dvec3 toLattice(const Lattice& lattice, const glm::vec3 position) {
    return (glm::dvec3(position) - glm::dvec3(lattice.origin)) * glm::dvec3(lattice.cellsPerUnit);
}

glm::dvec3 referenceMargin(const Lattice& lattice) {
    return kReferenceMargin * static_cast<double>(lattice.extent) * glm::dvec3(lattice.cellsPerUnit);
}

} // namespace metamarch
