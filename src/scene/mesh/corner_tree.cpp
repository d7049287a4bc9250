// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/corner_tree.h"

namespace metamarch {

void CornerTree::build(std::span<const glm::vec2> points, std::span<const std::uint32_t> members) {
    points_ = points;
    corners_.assign(members.begin(), members.end());
    leaf_.assign(points.size(), kNone);
    nodes_.clear();
    if (!members.empty()) {
        split(addNode(kNone, 0, static_cast<std::uint32_t>(members.size())));
    }
}

void CornerTree::remove(std::uint32_t corner) {
    for (std::uint32_t node = leaf_[corner]; node != kNone; node = nodes_[node].parent) {
        --nodes_[node].present;
    }
    leaf_[corner] = kNone;
}

std::uint32_t CornerTree::addNode(std::uint32_t parent, std::uint32_t begin, std::uint32_t end) {
    Node node{.lo = points_[corners_[begin]],
              .hi = points_[corners_[begin]],
              .parent = parent,
              .begin = begin,
              .end = end,
              .present = end - begin};
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        node.lo = glm::min(node.lo, points_[corners_[i]]);
        node.hi = glm::max(node.hi, points_[corners_[i]]);
    }
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

// Halves the corners, so the recursion is at most 32 deep.
void CornerTree::split(std::uint32_t index) {
    const Node node = nodes_[index];
    if (node.end - node.begin <= kLeafSize) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            leaf_[corners_[i]] = index;
        }
        return;
    }
    const int axis = node.hi.x / 2 - node.lo.x / 2 >= node.hi.y / 2 - node.lo.y / 2 ? 0 : 1;
    const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
    std::nth_element(corners_.begin() + node.begin, corners_.begin() + middle, corners_.begin() + node.end,
                     [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    const std::uint32_t left = addNode(index, node.begin, middle);
    addNode(index, middle, node.end);
    nodes_[index].left = left;
    split(left);
    split(left + 1);
}

// Whether a side of the triangle, or of the node's box, has all of the box, or all of the triangle, outside.
bool CornerTree::isApart(const Node& node, const std::array<glm::vec2, 3>& triangle) {
    const auto [x0, x1] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
    const auto [y0, y1] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    if (x1 < node.lo.x || x0 > node.hi.x || y1 < node.lo.y || y0 > node.hi.y) {
        return true;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2& a = triangle[i];
        const glm::vec2& b = triangle[(i + 1) % 3];
        // The corner of the box that lies farthest to the left of the side.
        const glm::vec2 farthest(b.y > a.y ? node.lo.x : node.hi.x, b.x > a.x ? node.hi.y : node.lo.y);
        if (orientation(a, b, farthest) < 0) {
            return true;
        }
    }
    return false;
}

} // namespace metamarch
