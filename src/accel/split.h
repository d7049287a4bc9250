// Where to split a kd-tree node: the surface area heuristic over every lattice plane inside it.
#pragma once
#include "metamarch/accel/triangle_clip.h"

#include <cstdint>
#include <optional>
#include <span>

namespace metamarch {

// A triangle inside a node: the cells that its part in the node touches.
struct TriangleReference {
    std::uint32_t triangleId;
    CellRange cells;
};

struct Split {
    unsigned axis;
    std::uint16_t plane; // cells below it belong to one child, the cell `plane` and those above to the other
    double cost;         // of a ray that crosses the node, in triangle tests, its children being leaves
};

// What the structure costs a ray, in units of one triangle test. Chosen by measurement: README.md in this
// folder.
inline constexpr double kStepCost = 1.5;
inline constexpr double kEmptyBonus = 0.2; // part of the cost that a split saves by cutting off empty space

// Of a ray that crosses a leaf. The march visits no inner nodes: a split costs by the leaves it adds to a
// ray's way.
constexpr double leafCost(const std::size_t references) {
    return kStepCost + static_cast<double>(references);
}

// To which the number of rays that cross a box is proportional.
inline double halfArea(const glm::dvec3& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

// What it costs a ray to cross a node that is split at a plane across `axis`, in triangle tests, its children
// being leaves. J. D. MacDonald, K. S. Booth, "Heuristics for ray tracing using space subdivision", The
// Visual Computer 6(3), 1990; empty-space bonus after Pharr & Humphreys, Physically Based Rendering, 2004,
// section 4.5.
class SplitCost {
  public:
    SplitCost(const glm::dvec3& nodeSize, const unsigned splitAxis)
        : size(nodeSize), axis(static_cast<int>(splitAxis)), invArea(1.0 / halfArea(nodeSize)) {}

    // `length` is that of the child below along the axis; the children hold `below` and `above` triangles.
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

// The cheapest split, or nothing when the node is one cell wide in every axis. Of equal costs the lowest axis
// and plane win.
std::optional<Split> findSplit(std::span<const TriangleReference> references, const CellRange& box,
                               const glm::dvec3& cellSize);

} // namespace metamarch
