// SPDX-License-Identifier: MIT
// Chooses where to split a kd-tree node: the surface area heuristic over every lattice plane inside the node.
#pragma once
#include "metamarch/accel/triangle_clip.h"

#include <cstdint>
#include <optional>
#include <span>

namespace metamarch {

// A triangle's reference in a node: the cells touched by the part of the triangle that lies in the node.
struct TriangleReference {
    std::uint32_t triangleId;
    CellRange cells;
};

struct Split {
    unsigned axis;
    // Cells below this index go to one child, the cell `plane` and those above to the other.
    std::uint16_t plane;
    // Expected cost of a ray that crosses the node, in triangle tests, if both children are leaves.
    double cost;
};

// Cost constants, in units of one triangle test. Chosen by measurement: src/accel/MEASURED.md.
inline constexpr double kStepCost = 1.5;
inline constexpr double kEmptyBonus = 0.2; // fraction of its cost that a split saves if one child is empty

// The cost of a ray that crosses a leaf. The march visits no inner nodes: a split costs only the leaves that
// it adds to a ray's path.
constexpr double leafCost(const std::size_t references) {
    return kStepCost + static_cast<double>(references);
}

// Half the surface area of a box. The number of random rays that hit the box is proportional to it.
inline double halfArea(const glm::dvec3& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

// The expected cost of a ray that crosses a node, in triangle tests, if a plane perpendicular to `axis`
// splits the node into two leaves. J. D. MacDonald, K. S. Booth, "Heuristics for ray tracing using space
// subdivision", The Visual Computer 6(3), 1990; empty-space bonus after Pharr & Humphreys, Physically Based
// Rendering, 2004, section 4.5.
class SplitCost {
  public:
    SplitCost(const glm::dvec3& nodeSize, const unsigned splitAxis)
        : size(nodeSize), axis(static_cast<int>(splitAxis)), invArea(1.0 / halfArea(nodeSize)) {}

    // `length` is the extent of the lower child along the axis; the children hold `below` and `above`
    // triangles.
    double operator()(const double length, const std::size_t below, const std::size_t above) const {
        glm::dvec3 lower = size;
        glm::dvec3 upper = size;
        lower[axis] = length;
        upper[axis] = size[axis] - length;
        const double crossings =
            invArea * (halfArea(lower) * leafCost(below) + halfArea(upper) * leafCost(above));
        return below == 0 || above == 0 ? (1.0 - kEmptyBonus) * crossings : crossings;
    }

  private:
    glm::dvec3 size;
    int axis;
    double invArea;
};

// Returns the cheapest split, or nothing if the node is one cell wide on every axis. Among equal costs, the
// lowest axis and then the lowest plane win.
std::optional<Split> findSplit(std::span<const TriangleReference> references, const CellRange& box,
                               const glm::dvec3& cellSize);

} // namespace metamarch
