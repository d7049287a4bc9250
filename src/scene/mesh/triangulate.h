// SPDX-License-Identifier: MIT
// Divides polygons into triangles.
#pragma once
#include "metamarch/scene/mesh/corner_tree.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// Keeps its memory from one polygon to the next.
class PolygonTriangulator {
  public:
    // Returns triangles as indices into `corners`, in the order of the polygon's corners; they stay valid
    // until the next call.
    //
    // A polygon may be concave, may have corners on straight edges and repeated corners, and may touch
    // itself, as one whose holes are joined to its border by edges. It is judged along the axis in which it
    // is seen largest, with exact predicates: there the triangles cover the polygon without gap or overlap,
    // and every corner between two others on a straight edge is a corner of a triangle.
    // - Three corners are one triangle, even without area. A larger polygon gives no triangle without area.
    // - Four corners whose both diagonals lie inside are divided from corner 0 to corner 2, as in most
    // programs.
    // - A polygon that crosses itself gives some triangles.
    // - A polygon with a corner that is not finite gives a fan.
    // The time for n corners is about n log n, and at most a multiple of n sqrt(n). A polygon that would need
    // more is finished without looking whether other corners lie in a triangle: see ranOutOfWork().
    std::span<const glm::uvec3> triangulate(std::span<const glm::vec3> corners);

    // Whether the last polygon would have needed too much time. Its triangles may overlap, lie outside it and
    // leave out parts and corners of it.
    bool ranOutOfWork() const { return work_ < 0; }

  private:
    void project(std::span<const glm::vec3> corners);
    int turnOfLeftmost() const;
    bool divideQuad();
    void divideByEars();
    void link();
    void unlink(std::uint32_t corner);
    void dropSpikes();
    void findBlockers();
    void cutEars();
    void cutAny();
    void cut(std::uint32_t corner);
    void lookAtNextRound(std::uint32_t corner);
    int turn(std::uint32_t corner) const; // 1: left, 0: straight on or back, -1: right
    bool isSpike(std::uint32_t corner) const;
    bool isEar(std::uint32_t corner);
    bool blocks(std::uint32_t other, std::uint32_t corner) const;
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles_.emplace_back(a, b, c); }

    std::vector<glm::vec2> points_; // the corners seen along an axis, counter-clockwise
    std::vector<glm::uvec3> triangles_;

    // The corners that are left form a ring.
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::uint32_t left_ = 0;  // how many are left
    std::uint32_t start_ = 0; // one of them

    // Corners that do not turn left: only these can lie in the way of an ear.
    CornerTree blockers_;
    std::vector<bool> isBlocker_;

    // The corners to look at in this round and in the next one.
    std::vector<std::uint32_t> queue_;
    std::vector<std::uint32_t> nextQueue_;
    std::vector<std::uint32_t> changedIn_; // the last round in which a neighbour was cut off
    std::vector<bool> isQueued_;           // in nextQueue_
    std::uint32_t round_ = 0;
    std::int64_t work_ = 0; // how many more nodes and corners of the tree may be looked at
};

} // namespace metamarch
