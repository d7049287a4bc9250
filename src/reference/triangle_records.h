// SPDX-License-Identifier: MIT
// Tests triangle records on the CPU: the judges' counterpart of shaders/lib/scene.glsl.
#pragma once
#include "metamarch/reference/trace.h"

namespace metamarch {

// Tests the triangle of record `recordIndex` and stores the hit in `trace` if it is closer than the hit
// there.
inline void testTriangle(const std::span<const TriangleRecord> triangles, const Ray& ray,
                         const std::uint32_t recordIndex, TraceResult& trace) {
    ++trace.tests;
    const TriangleRecord& triangle = triangles[recordIndex];
    const float t = intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2);
    if (t != kNoHit && isCloser(t, triangle.triangleId, trace.hit)) {
        trace.hit = {t, triangle.triangleId};
        trace.recordIndex = recordIndex;
    }
}

inline void testTriangles(const std::span<const TriangleRecord> triangles, const Ray& ray,
                          const std::uint32_t first, const std::uint32_t count, TraceResult& trace) {
    for (std::uint32_t i = 0; i < count; ++i) {
        testTriangle(triangles, ray, first + i, trace);
    }
}

inline TraceResult startTrace(const Ray& ray) { return {{ray.tMax, kNoTriangle}}; }

inline bool isDone(const TraceResult& trace, const HitQuery query) {
    return query == HitQuery::any && trace.hit.triangleId != kNoTriangle;
}

} // namespace metamarch
