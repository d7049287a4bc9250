#include "reference/triangle_records.h"

namespace metamarch {

TraceResult traceBruteForce(const std::span<const std::uint32_t> triangleWords, const Ray& ray,
                            const HitQuery query) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const auto count = static_cast<std::uint32_t>(triangleWords.size() / kTriangleWords);
    for (std::uint32_t slot = 0; slot < count && !isDone(trace, query); ++slot) {
        testTriangle(triangleWords, ray, slot, trace);
    }
    return trace;
}

} // namespace metamarch
