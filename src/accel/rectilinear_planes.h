// SPDX-License-Identifier: MIT
// The planes of a lattice of uneven cells, and the search that finds the cell of a position.
#pragma once
#include "metamarch/accel/triangle_clip.h"
#include "metamarch/shared/rectilinear.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace metamarch {

class RectilinearPlanes {
  public:
    // `inner` holds the planes of each axis, in any order. Duplicates and planes that do not lie between 0
    // and `extent` are dropped. At most kMaxLatticeResolution - 1 per axis may remain.
    RectilinearPlanes(std::array<std::vector<float>, 3> inner, vec3 extent);

    const Rectilinear& layout() const { return shape; }
    const std::vector<float>& planes() const { return allPlanes; }
    const std::vector<std::uint32_t>& buckets() const { return cellOfBucket; }

    float plane(int axis, int index) const;

    // Returns the index of a plane that the constructor was given; 0 or the resolution for a plane outside.
    std::uint32_t numberOf(int axis, float plane) const;

    // Searches like the shader: finds, per axis, the last plane that is not behind the coordinate. The result
    // may lie outside the lattice.
    ivec3 searchCell(vec3 position) const;

    // Does what touchedCells does, for this lattice.
    std::optional<CellRange> touchedCells(const LatticeTriangle& triangle, const CellRange& box,
                                          const glm::dvec3& margin) const;

  private:
    void addBuckets(int axis, float extent);

    Rectilinear shape{};
    std::vector<float> allPlanes;
    std::vector<std::uint32_t> cellOfBucket;
};

} // namespace metamarch
