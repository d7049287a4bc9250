// SPDX-License-Identifier: MIT
// Ear clipping (G. H. Meisters, "Polygons Have Ears", 1975): cut off a corner that turns left whose triangle
// holds no other corner, until three are left. Whether a corner is an ear changes only when a neighbour is
// cut off, so each corner is looked at again at most twice for each ear.
#include "metamarch/scene/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

constexpr std::uint32_t kCutOff = 0xffffffffu;

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Whether `value` lies in the closed interval between two others.
bool isBetween(float a, float value, float b) { return std::min(a, b) <= value && value <= std::max(a, b); }

// The axis in which a polygon is seen largest, and from which side it is seen counter-clockwise.
struct View {
    int axis;
    int sign; // 0 if rounding could have made it
};

int axisOfLeastExtent(std::span<const glm::vec3> corners) {
    glm::vec3 lo = corners[0];
    glm::vec3 hi = corners[0];
    for (const glm::vec3& corner : corners) {
        lo = glm::min(lo, corner);
        hi = glm::max(hi, corner);
    }
    const glm::dvec3 extent = glm::dvec3(hi) - glm::dvec3(lo);
    return extent.z <= std::min(extent.x, extent.y) ? 2 : extent.y <= extent.x ? 1 : 0;
}

// By Newell's normal: its components are twice the areas that are seen along the axes.
View viewOf(std::span<const glm::vec3> corners) {
    const glm::dvec3 origin(corners[0]);
    glm::dvec3 normal(0.0);
    double size = 0.0; // of the terms of the sum
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::dvec3 a = glm::dvec3(corners[i]) - origin;
        const glm::dvec3 b = glm::dvec3(corners[i + 1]) - origin;
        normal += glm::cross(a, b);
        const glm::dvec3 sizeA = glm::abs(a);
        const glm::dvec3 sizeB = glm::abs(b);
        size += (sizeA.x + sizeA.y + sizeA.z) * (sizeB.x + sizeB.y + sizeB.z);
    }
    const glm::dvec3 area = glm::abs(normal);
    const double most = std::max({area.x, area.y, area.z});
    if (most == 0.0) {
        return {axisOfLeastExtent(corners), 0};
    }
    const int axis = area.z == most ? 2 : area.y == most ? 1 : 0;
    const double error = 0x1p-52 * (static_cast<double>(corners.size()) + 4.0) * size;
    return {axis, most <= error ? 0 : normal[axis] > 0.0 ? 1 : -1};
}

} // namespace

std::span<const glm::uvec3> PolygonTriangulator::triangulate(std::span<const glm::vec3> corners) {
    triangles_.clear();
    work_ = 0;
    if (corners.size() == 3) {
        addTriangle(0, 1, 2);
    } else if (!std::ranges::all_of(corners, isFinite)) {
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            addTriangle(0, i - 1, i);
        }
    } else if (corners.size() > 3) {
        project(corners);
        if (corners.size() != 4 || !divideQuad()) {
            divideByEars();
        }
    }
    return triangles_;
}

void PolygonTriangulator::project(std::span<const glm::vec3> corners) {
    const View view = viewOf(corners);
    const int right = (view.axis + 1) % 3;
    const int up = (view.axis + 2) % 3;
    points_.clear();
    for (const glm::vec3& corner : corners) {
        points_.emplace_back(corner[right], corner[up]);
    }
    const int sign = view.sign != 0 ? view.sign : turnOfLeftmost();
    if (sign < 0) { // exchanging the coordinates turns a polygon around
        for (glm::vec2& point : points_) {
            std::swap(point.x, point.y);
        }
    }
}

// The leftmost corner of a simple polygon turns like the polygon.
int PolygonTriangulator::turnOfLeftmost() const {
    const std::size_t count = points_.size();
    std::size_t leftmost = 0;
    for (std::size_t i = 1; i < count; ++i) {
        const glm::vec2& best = points_[leftmost];
        if (points_[i].x < best.x || (points_[i].x == best.x && points_[i].y < best.y)) {
            leftmost = i;
        }
    }
    std::size_t before = 1;
    while (before < count && points_[(leftmost + count - before) % count] == points_[leftmost]) {
        ++before;
    }
    std::size_t after = 1;
    while (after < count && points_[(leftmost + after) % count] == points_[leftmost]) {
        ++after;
    }
    return orientation(points_[(leftmost + count - before) % count], points_[leftmost],
                       points_[(leftmost + after) % count]);
}

bool PolygonTriangulator::divideQuad() {
    const auto turnsLeft = [this](int a, int b, int c) {
        return orientation(points_[static_cast<std::size_t>(a)], points_[static_cast<std::size_t>(b)],
                           points_[static_cast<std::size_t>(c)]) > 0;
    };
    if (turnsLeft(0, 1, 2) && turnsLeft(0, 2, 3)) {
        addTriangle(0, 1, 2);
        addTriangle(0, 2, 3);
        return true;
    }
    if (turnsLeft(1, 2, 3) && turnsLeft(1, 3, 0)) {
        addTriangle(1, 2, 3);
        addTriangle(1, 3, 0);
        return true;
    }
    return false;
}

void PolygonTriangulator::divideByEars() {
    link();
    dropSpikes();
    findBlockers();
    const auto count = static_cast<double>(points_.size());
    work_ = static_cast<std::int64_t>(8.0 * count * std::sqrt(count)) + 4096;
    while (left_ > 3) {
        if (queue_.empty()) {
            cutAny();
        } else {
            cutEars();
        }
        queue_.swap(nextQueue_);
        nextQueue_.clear();
        for (const std::uint32_t corner : queue_) {
            isQueued_[corner] = false;
        }
    }
    if (left_ == 3 && turn(start_) != 0) {
        addTriangle(previous_[start_], start_, next_[start_]);
    }
}

void PolygonTriangulator::link() {
    left_ = static_cast<std::uint32_t>(points_.size());
    start_ = 0;
    next_.resize(left_);
    previous_.resize(left_);
    for (std::uint32_t i = 0; i < left_; ++i) {
        next_[i] = i + 1 < left_ ? i + 1 : 0;
        previous_[i] = i > 0 ? i - 1 : left_ - 1;
    }
}

void PolygonTriangulator::unlink(std::uint32_t corner) {
    next_[previous_[corner]] = next_[corner];
    previous_[next_[corner]] = previous_[corner];
    start_ = next_[corner];
    next_[corner] = kCutOff;
    --left_;
}

// A removed spike can make spikes of its neighbours: go back to the one before it, and at the end once more
// to the first corner.
void PolygonTriangulator::dropSpikes() {
    std::uint32_t passed = 0;
    std::uint32_t corner = start_;
    while (passed <= left_ && left_ > 2) {
        if (!isSpike(corner)) {
            corner = next_[corner];
            ++passed;
            continue;
        }
        const std::uint32_t before = previous_[corner];
        unlink(corner);
        corner = before;
        passed -= std::min(passed, 1u);
    }
}

void PolygonTriangulator::findBlockers() {
    const std::size_t count = points_.size();
    isBlocker_.assign(count, false);
    isQueued_.assign(count, false);
    changedIn_.assign(count, 0);
    round_ = 0;
    queue_.clear();
    std::uint32_t corner = start_;
    for (std::uint32_t i = 0; i < left_; ++i, corner = next_[corner]) {
        if (turn(corner) <= 0) {
            isBlocker_[corner] = true;
            queue_.push_back(corner);
        }
    }
    blockers_.build(points_, queue_);
    queue_.clear();
    for (std::uint32_t i = 0; i < left_; ++i, corner = next_[corner]) {
        queue_.push_back(corner);
    }
}

// Cuts off the ears of a round. Neighbours of an ear wait for the next round, which keeps triangles from
// becoming thin.
void PolygonTriangulator::cutEars() {
    ++round_;
    for (const std::uint32_t corner : queue_) {
        if (left_ <= 3) {
            return;
        }
        if (next_[corner] == kCutOff) {
            continue;
        }
        if (changedIn_[corner] == round_) {
            lookAtNextRound(corner);
        } else if (isSpike(corner)) {
            cut(corner);
        } else if (isEar(corner)) {
            addTriangle(previous_[corner], corner, next_[corner]);
            cut(corner);
        }
    }
}

// Only a polygon that crosses itself comes to an end of its ears. Prefers a corner that turns left.
void PolygonTriangulator::cutAny() {
    constexpr int kTries = 16;
    std::uint32_t corner = start_;
    for (int i = 0; i < kTries && turn(corner) <= 0; ++i) {
        corner = next_[corner];
    }
    if (turn(corner) != 0) {
        addTriangle(previous_[corner], corner, next_[corner]);
    }
    cut(corner);
}

void PolygonTriangulator::cut(std::uint32_t corner) {
    const std::array<std::uint32_t, 2> neighbours = {previous_[corner], next_[corner]};
    unlink(corner);
    if (isBlocker_[corner]) {
        blockers_.remove(corner);
    }
    for (const std::uint32_t neighbour : neighbours) {
        changedIn_[neighbour] = round_;
        lookAtNextRound(neighbour);
        if (isBlocker_[neighbour] && turn(neighbour) > 0) {
            isBlocker_[neighbour] = false;
            blockers_.remove(neighbour);
        }
    }
}

void PolygonTriangulator::lookAtNextRound(std::uint32_t corner) {
    if (!isQueued_[corner]) {
        isQueued_[corner] = true;
        nextQueue_.push_back(corner);
    }
}

int PolygonTriangulator::turn(std::uint32_t corner) const {
    return orientation(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

// Whether the corner has no area: it repeats a neighbour, or the polygon goes back the way it came.
bool PolygonTriangulator::isSpike(std::uint32_t corner) const {
    const glm::vec2& a = points_[previous_[corner]];
    const glm::vec2& b = points_[corner];
    const glm::vec2& c = points_[next_[corner]];
    if (a == b || b == c) {
        return true;
    }
    return orientation(a, b, c) == 0 && !(isBetween(a.x, b.x, c.x) && isBetween(a.y, b.y, c.y));
}

// Only corners that do not turn left need a look. If corners of a simple polygon lie in the triangle, take
// the one farthest from the new side. Both its neighbours are nearer to that side, so it does not turn left.
bool PolygonTriangulator::isEar(std::uint32_t corner) {
    if (turn(corner) <= 0) {
        return false;
    }
    const std::array<glm::vec2, 3> triangle = {points_[previous_[corner]], points_[corner],
                                               points_[next_[corner]]};
    return !blockers_.anyInside(triangle, work_, [&](std::uint32_t other) { return blocks(other, corner); });
}

// Whether `other`, which lies in the closed triangle of `corner`, keeps it from being an ear. One at the same
// place as an end of the new side does not: where the polygon goes on from there into the triangle, another
// corner lies in it. One at the same place as `corner` does if the polygon goes on into the triangle.
bool PolygonTriangulator::blocks(std::uint32_t other, std::uint32_t corner) const {
    if (other == corner || other == previous_[corner] || other == next_[corner]) {
        return false;
    }
    const glm::vec2& a = points_[previous_[corner]];
    const glm::vec2& b = points_[corner];
    const glm::vec2& c = points_[next_[corner]];
    const glm::vec2& point = points_[other];
    if (point == a || point == c) {
        return false;
    }
    const auto goesInto = [&](const glm::vec2& neighbour) {
        return orientation(a, b, neighbour) > 0 && orientation(b, c, neighbour) > 0;
    };
    return point != b || goesInto(points_[previous_[other]]) || goesInto(points_[next_[other]]);
}

} // namespace metamarch
