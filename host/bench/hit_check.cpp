// SPDX-License-Identifier: MIT
#include "metamarch/bench/hit_check.h"

#include "metamarch/accel/lattice.h"

#include <bit>
#include <cmath>

namespace metamarch::bench {
namespace {

constexpr double kDeviceBudget = 2e-5;

bool isHit(const RayResult& result) { return result.triangleId != kNoTriangle; }

bool isSameHit(const RayQuery& ray, const RayResult& a, const RayResult& b, const float distance) {
    if (distance == 0.0f) {
        return a.triangleId == b.triangleId &&
               std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t);
    }
    // The t of a ray with a distant origin is itself rounded; allow two ulps of it.
    const float rounding = 0x1p-22f * std::max(std::abs(a.t), std::abs(b.t));
    return std::abs(a.t - b.t) <= distance / glm::length(ray.dir) + rounding;
}

} // namespace

HitTolerance toleranceOn(const bool keepsBits, const Lattice& lattice) {
    if (keepsBits) {
        return {};
    }
    return {static_cast<float>(kReferenceMargin) * lattice.extent, kDeviceBudget};
}

std::uint64_t countDifferent(const std::span<const RayQuery> rays, const std::span<const RayResult> results,
                             const std::span<const RayResult> judged, const HitQuery query,
                             const HitTolerance& tolerance) {
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool same = isHit(results[i]) == isHit(judged[i]) &&
                          (query == HitQuery::any || !isHit(judged[i]) ||
                           isSameHit(rays[i], results[i], judged[i], tolerance.distance));
        different += same ? 0 : 1;
    }
    return different;
}

bool isWithinBudget(const std::uint64_t different, const std::size_t rayCount,
                    const HitTolerance& tolerance) {
    return static_cast<double>(different) <= tolerance.budget * static_cast<double>(rayCount);
}

} // namespace metamarch::bench
