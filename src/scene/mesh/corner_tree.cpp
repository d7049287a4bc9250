// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/corner_tree.h"

#include <cmath>

namespace metamarch {
namespace {

// Whether the point surely lies to the right of the line from a to b. May be false by rounding, never true.
bool isRightOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    const double left = (b.x - a.x) * (point.y - a.y);
    const double right = (b.y - a.y) * (point.x - a.x);
    return right - left > 0x1p-50 * (std::abs(left) + std::abs(right)); // 8 roundings; there are 5
}

// Whether all of the points surely lie to the right of one side of the polygon.
template <std::size_t N, std::size_t M>
bool sideSeparates(const std::array<glm::dvec2, N>& polygon, const std::array<glm::dvec2, M>& points) {
    for (std::size_t i = 0; i < N; ++i) {
        if (std::ranges::all_of(points, [&](const glm::dvec2& point) {
                return isRightOf(polygon[i], polygon[(i + 1) % N], point);
            })) {
            return true;
        }
    }
    return false;
}

// The greater axis of a box.
int axisOf(const glm::vec2& lo, const glm::vec2& hi) {
    return hi.x / 2 - lo.x / 2 >= hi.y / 2 - lo.y / 2 ? 0 : 1;
}

} // namespace

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
              .strip = {},
              .parent = parent,
              .begin = begin,
              .end = end,
              .present = end - begin};
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        node.lo = glm::min(node.lo, points_[corners_[i]]);
        node.hi = glm::max(node.hi, points_[corners_[i]]);
    }
    node.strip = stripOf(node);
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

// Between the corners that are first and last along the greater axis, and as wide as the others need.
CornerTree::Strip CornerTree::stripOf(const Node& node) const {
    const int along = axisOf(node.lo, node.hi);
    const int across = 1 - along;
    const auto [firstCorner, lastCorner] = std::minmax_element(
        corners_.begin() + node.begin, corners_.begin() + node.end,
        [&](std::uint32_t a, std::uint32_t b) { return points_[a][along] < points_[b][along]; });
    const glm::dvec2 first(points_[*firstCorner]);
    const glm::dvec2 last(points_[*lastCorner]);
    const double length = last[along] - first[along];
    const double slope = length > 0.0 ? (last[across] - first[across]) / length : 0.0;
    double least = 0.0;
    double most = 0.0;
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const glm::dvec2 point(points_[corners_[i]]);
        const double offset = point[across] - first[across] - slope * (point[along] - first[along]);
        least = std::min(least, offset);
        most = std::max(most, offset);
    }
    // 32 roundings; fewer make the offsets and the sums below.
    const double error = 0x1p-48 * (std::abs(static_cast<double>(node.lo[across])) +
                                    std::abs(static_cast<double>(node.hi[across])));
    const auto at = [&](const glm::dvec2& end, double offset) {
        glm::dvec2 point(end);
        point[across] += offset;
        return point;
    };
    Strip strip = {at(first, least - error), at(last, least - error), at(last, most + error),
                   at(first, most + error)};
    if (along == 1) { // seen with exchanged axes
        std::swap(strip[1], strip[3]);
    }
    return strip;
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
    const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
    const std::uint32_t left = addNode(index, node.begin, middle);
    addNode(index, middle, node.end);
    nodes_[index].left = left;
    split(left);
    split(left + 1);
}

// Whether a line separates the triangle from the node's corners: a side of the triangle, of their box or of
// their strip.
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
    const std::array<glm::dvec2, 3> corners = {triangle[0], triangle[1], triangle[2]};
    return sideSeparates(corners, node.strip) || sideSeparates(node.strip, corners);
}

} // namespace metamarch
