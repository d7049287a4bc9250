// SPDX-License-Identifier: MIT
// Finds corners of a polygon that lie in a triangle.
#pragma once
#include "metamarch/scene/mesh/orientation.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// A tree over some corners of a polygon, from which corners can be removed. Each node holds corners that
// follow each other, as a node with corners from both sides of a narrow passage would lie in every triangle
// of it.
class CornerTree {
  public:
    // `points` are those of all corners, and `members` the corners that the tree holds, in their order.
    // The points must stay until the next build.
    void build(std::span<const glm::vec2> points, std::span<const std::uint32_t> members);

    void remove(std::uint32_t corner);

    // Whether `accept` returns true for any corner in the closed triangle, whose corners are
    // counter-clockwise. Subtracts from `work` the nodes and corners that it looks at; returns false once
    // `work` is used up.
    template <class Accept>
    bool anyInside(const std::array<glm::vec2, 3>& triangle, std::int64_t& work, const Accept& accept) const {
        return !nodes_.empty() && anyInside(0, triangle, work, accept);
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::size_t kLeafSize = 8;

    // A parallelogram around corners. Two of its sides lie along the lesser axis of their box, and two in the
    // direction of the corners, so corners on or near a slanted line have a thin one. Counter-clockwise.
    using Strip = std::array<glm::dvec2, 4>;

    struct Node {
        glm::vec2 lo;
        glm::vec2 hi;
        Strip strip;
        std::uint32_t parent;
        std::uint32_t left = kNone; // the right child follows it; none in a leaf
        std::uint32_t begin;        // into corners_
        std::uint32_t end;
        std::uint32_t present; // corners that are not removed
    };

    void split(std::uint32_t node);
    std::uint32_t addNode(std::uint32_t parent, std::uint32_t begin, std::uint32_t end);
    Strip stripOf(const Node& node) const;
    static bool isApart(const Node& node, const std::array<glm::vec2, 3>& triangle);

    template <class Accept>
    bool anyInside(std::uint32_t index, const std::array<glm::vec2, 3>& triangle, std::int64_t& work,
                   const Accept& accept) const {
        const Node& node = nodes_[index];
        if (node.present == 0 || --work < 0 || isApart(node, triangle)) {
            return false;
        }
        if (node.left != kNone) {
            return anyInside(node.left, triangle, work, accept) ||
                   anyInside(node.left + 1, triangle, work, accept);
        }
        work -= node.end - node.begin;
        return std::any_of(
            corners_.begin() + node.begin, corners_.begin() + node.end, [&](std::uint32_t corner) {
                return leaf_[corner] != kNone &&
                       orientation(triangle[0], triangle[1], points_[corner]) >= 0 &&
                       orientation(triangle[1], triangle[2], points_[corner]) >= 0 &&
                       orientation(triangle[2], triangle[0], points_[corner]) >= 0 && accept(corner);
            });
    }

    std::span<const glm::vec2> points_;
    std::vector<std::uint32_t> corners_; // in the order of the polygon
    std::vector<std::uint32_t> leaf_;    // indexed by corner: the node that holds it, or kNone
    std::vector<Node> nodes_;
};

} // namespace metamarch
