// SPDX-License-Identifier: MIT
#include "metamarch/reference/triangle_records.h"
#include "metamarch/reference/twins.h"

namespace metamarch {

[[gnu::flatten]] TraceResult traceBruteForce(const std::span<const TriangleRecord> triangles, const Ray& ray,
                                             const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const auto count = static_cast<std::uint32_t>(triangles.size());
    for (std::uint32_t recordIndex = 0; recordIndex < count && !isDone(trace, query); ++recordIndex) {
        testTriangle(triangles, ray, recordIndex, trace);
    }
    return trace;
}

namespace brute_force {
namespace {

TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    return traceBruteForce(structures.triangles(), ray, query);
}

} // namespace

extern const TwinLoop kLoop{traverse, traverse};

} // namespace brute_force
} // namespace metamarch
