// The planes of a lattice of uneven cells, and how positions find their cells.
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
    // `inner` are the planes of each axis, in any order, between 0 and `extent`; those outside or there twice
    // do not count. At most kMaxLatticeResolution - 1 are left.
    RectilinearPlanes(std::array<std::vector<float>, 3> inner, vec3 extent);

    const Rectilinear& layout() const { return shape; }
    const std::vector<float>& planes() const { return allPlanes; }
    const std::vector<std::uint32_t>& buckets() const { return cellOfBucket; }

    float plane(int axis, int index) const;

    // The number of a plane that the constructor was given; 0 or the resolution for one outside.
    std::uint32_t numberOf(int axis, float plane) const;

    // As the shader searches: the last plane not behind each coordinate; may lie outside the lattice.
    ivec3 searchCell(vec3 position) const;

    // touchedCells of this lattice.
    std::optional<CellRange> touchedCells(const LatticeTriangle& triangle, const CellRange& box,
                                          const glm::dvec3& margin) const;

  private:
    void addBuckets(int axis, float extent);

    Rectilinear shape{};
    std::vector<float> allPlanes;
    std::vector<std::uint32_t> cellOfBucket;
};

} // namespace metamarch
