// SPDX-License-Identifier: MIT
#include "metamarch/accel/triangle_clip.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace metamarch {
namespace {

// A triangle cut by six planes has at most nine corners.
struct Polygon {
    std::array<glm::dvec3, 9> corners;
    std::size_t size = 0;
};

// Makes `kept` the part of the polygon where side * (p[axis] - plane) >= 0.
void clip(const Polygon& polygon, const int axis, const double plane, const double side, Polygon& kept) {
    kept.size = 0;
    if (polygon.size == 0) {
        return;
    }
    double dp = side * (polygon.corners[0][axis] - plane);
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const glm::dvec3& p = polygon.corners[i];
        const glm::dvec3& q = polygon.corners[i + 1 == polygon.size ? 0 : i + 1];
        const double dq = side * (q[axis] - plane);
        if (dp >= 0.0) {
            kept.corners[kept.size++] = p;
        }
        if ((dp < 0.0) != (dq < 0.0)) {
            glm::dvec3& cut = kept.corners[kept.size++];
            cut = p + (q - p) * (dp / (dp - dq));
            cut[axis] = plane;
        }
        dp = dq;
    }
}

} // namespace

std::optional<Box> clipTriangle(const LatticeTriangle& triangle, const Box& box) {
    std::array<Polygon, 2> polygons;
    Polygon* polygon = &polygons[0];
    Polygon* spare = &polygons[1];
    std::copy(triangle.begin(), triangle.end(), polygon->corners.begin());
    polygon->size = 3;
    const auto cut = [&](const int axis, const double plane, const double side) {
        clip(*polygon, axis, plane, side, *spare);
        std::swap(polygon, spare);
    };
    const glm::dvec3 lo = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec3 hi = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    for (int axis = 0; axis < 3; ++axis) {
        if (lo[axis] < box.lo[axis]) {
            cut(axis, box.lo[axis], 1.0);
        }
        if (hi[axis] > box.hi[axis]) {
            cut(axis, box.hi[axis], -1.0);
        }
    }
    if (polygon->size == 0) {
        return std::nullopt;
    }
    Box part;
    for (std::size_t i = 0; i < polygon->size; ++i) {
        part.grow({polygon->corners[i], polygon->corners[i]});
    }
    return part;
}

std::optional<CellRange> touchedCells(const LatticeTriangle& triangle, const CellRange& box,
                                      const glm::dvec3& margin) {
    const glm::dvec3 lo(box.lo[0], box.lo[1], box.lo[2]);
    const glm::dvec3 hi(box.hi[0], box.hi[1], box.hi[2]);
    const std::optional<Box> part = clipTriangle(triangle, {lo - margin, hi + 1.0 + margin});
    if (!part) {
        return std::nullopt;
    }
    const glm::dvec3 first = glm::clamp(glm::floor(part->lo - margin), lo, hi);
    const glm::dvec3 last = glm::clamp(glm::floor(part->hi + margin), lo, hi);
    CellRange range;
    for (std::size_t i = 0; i < 3; ++i) {
        range.lo[i] = static_cast<std::uint16_t>(first[static_cast<int>(i)]);
        range.hi[i] = static_cast<std::uint16_t>(last[static_cast<int>(i)]);
    }
    return range;
}

std::vector<RowOfCells> touchedRows(const LatticeTriangle& triangle, const glm::uvec3 resolution,
                                    const glm::dvec3& margin) {
    const CellRange whole{{0, 0, 0},
                          {static_cast<std::uint16_t>(resolution.x - 1),
                           static_cast<std::uint16_t>(resolution.y - 1),
                           static_cast<std::uint16_t>(resolution.z - 1)}};
    std::vector<RowOfCells> rows;
    const auto range = touchedCells(triangle, whole, margin);
    for (std::uint16_t z = range->lo[2]; z <= range->hi[2]; ++z) {
        for (std::uint16_t y = range->lo[1]; y <= range->hi[1]; ++y) {
            const CellRange row{{range->lo[0], y, z}, {range->hi[0], y, z}};
            // The part of the triangle in the row is convex, so it touches one contiguous run of cells.
            if (const auto run = touchedCells(triangle, row, margin)) {
                rows.push_back({run->lo[0], static_cast<std::uint16_t>(run->hi[0] + 1), y, z});
            }
        }
    }
    return rows;
}

} // namespace metamarch
