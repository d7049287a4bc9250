// Reading triangle records on the CPU: the judges' counterpart of shaders/lib/scene.glsl.
#pragma once
#include "reference/trace.h"

#include <bit>

namespace metamarch {

// Corner 0, 1 or 2 of the triangle in `slot`, its coordinates in the order of `axes`.
inline vec3 triangleCorner(const std::span<const std::uint32_t> words, const std::uint32_t slot,
                           const std::uint32_t corner, const uvec3 axes) {
    const std::uint32_t* const record = &words[std::size_t{slot} * kTriangleWords + 3 * corner];
    return {std::bit_cast<float>(record[axes.x]), std::bit_cast<float>(record[axes.y]),
            std::bit_cast<float>(record[axes.z])};
}

// Tests the triangle in `slot` and keeps it where it is closer than what `trace` has.
inline void testTriangle(const std::span<const std::uint32_t> words, const Ray& ray, const std::uint32_t slot,
                         TraceResult& trace) {
    ++trace.tests;
    const float t =
        intersectTriangle(ray, triangleCorner(words, slot, 0, ray.axes),
                          triangleCorner(words, slot, 1, ray.axes), triangleCorner(words, slot, 2, ray.axes));
    const std::uint32_t triangleId = words[std::size_t{slot} * kTriangleWords + kTriangleIdWord];
    if (t != kNoHit && isCloser(t, triangleId, trace.hit)) {
        trace.hit = {t, triangleId};
        trace.slot = slot;
    }
}

inline TraceResult startTrace(const Ray& ray) { return {{ray.tMax, kNoTriangle}}; }

inline bool isDone(const TraceResult& trace, const HitQuery query) {
    return query == HitQuery::any && trace.hit.triangleId != kNoTriangle;
}

} // namespace metamarch
