// SPDX-License-Identifier: MIT
#include "metamarch/accel/uniform_grid.h"

#include "metamarch/accel/triangle_clip.h"
#include "metamarch/error/error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

// Density in cells per triangle: I. Wald, T. Ize, A. Kensler, A. Knoll, S. Parker, "Ray Tracing Animated
// Scenes Using Coherent Grid Traversal", SIGGRAPH 2006, section 4 (lambda = 5).
constexpr double kGridDensity = 5.0;
constexpr double kMostGridCells = 0x1p23; // 8 bytes each

// Chooses cells that are as close to cubes as the box allows.
uvec3 gridResolution(const Lattice& lattice) {
    const glm::dvec3 extent = glm::dvec3(lattice.resolution) / glm::dvec3(lattice.cellsPerUnit);
    const double cells = std::clamp(kGridDensity * lattice.triangleCount, 1.0, kMostGridCells);
    const double perUnit = std::cbrt(cells / (extent.x * extent.y * extent.z));
    return uvec3(
        glm::clamp(glm::floor(extent * perUnit), glm::dvec3(1.0), glm::dvec3(kMaxLatticeResolution)));
}

} // namespace

UniformGrid buildUniformGrid(const Lattice& lattice, const std::span<const TriangleRecord> triangles) {
    UniformGrid result;
    Grid& grid = result.grid;
    grid.resolution = gridResolution(lattice);
    grid.cellCount = grid.resolution.x * grid.resolution.y * grid.resolution.z;
    grid.scale = vec3(grid.resolution) / vec3(lattice.resolution);
    grid.padding = 0;

    const glm::dvec3 scale(grid.scale);
    const glm::dvec3 margin = referenceMargin(lattice) * scale;
    std::vector<std::vector<RowOfCells>> rowsOf(triangles.size());
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](const std::size_t i) {
        const TriangleRecord& triangle = triangles[i];
        rowsOf[i] =
            touchedRows({toLattice(lattice, triangle.v0) * scale, toLattice(lattice, triangle.v1) * scale,
                         toLattice(lattice, triangle.v2) * scale},
                        grid.resolution, margin);
    });

    const auto forEachCell = [&](const std::vector<RowOfCells>& rows, const auto& visit) {
        for (const RowOfCells& row : rows) {
            const std::uint32_t first = cellIndex(ivec3(0, row.y, row.z), grid.resolution);
            for (std::uint32_t x = row.x; x < row.endX; ++x) {
                visit(result.cells[first + x]);
            }
        }
    };
    result.cells.resize(grid.cellCount);
    for (const auto& rows : rowsOf) {
        forEachCell(rows, [](GridCell& cell) { ++cell.triangleCount; });
    }
    std::uint64_t references = 0;
    for (GridCell& cell : result.cells) {
        cell.firstTriangle = static_cast<std::uint32_t>(references);
        references += cell.triangleCount;
        cell.triangleCount = 0;
        if (references >= (std::uint64_t{1} << 30u)) {
            throw Error(ErrorKind::outOfMemory, "the uniform grid has more than 2^30 references");
        }
    }
    result.triangles.resize(references);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        forEachCell(rowsOf[i], [&](GridCell& cell) {
            result.triangles[cell.firstTriangle + cell.triangleCount++] = triangles[i];
        });
    }
    return result;
}

} // namespace metamarch
