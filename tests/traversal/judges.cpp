// SPDX-License-Identifier: MIT
#include "traversal/judges.h"

#include "fixtures/ray_sets.h"

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <bit>

namespace metamarch::tests {
namespace {

void expectAgreement(const std::span<const RayQuery> rays, const std::span<const RayResult> results,
                     const std::span<const RayResult> expected,
                     const std::function<bool(const RayResult&, const RayResult&)>& agree) {
    ASSERT_EQ(results.size(), rays.size());
    ASSERT_EQ(expected.size(), rays.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!agree(results[i], expected[i]) && ++different <= 5) {
            ADD_FAILURE() << "ray " << i << ": " << describe(rays[i]) << "\n  triangle "
                          << results[i].triangleId << " at " << results[i].t << " in " << results[i].steps
                          << " steps, " << results[i].tests << " tests; expected triangle "
                          << expected[i].triangleId << " at " << expected[i].t << " in " << expected[i].steps
                          << " steps, " << expected[i].tests << " tests";
        }
    }
    EXPECT_EQ(different, 0u) << "of " << rays.size() << " rays";
}

bool isMiss(const RayResult& result) { return result.triangleId == kNoTriangle; }

} // namespace

std::vector<RayResult> traceAll(const Lattice& lattice, const std::span<const RayQuery> rays,
                                const Judge& judge) {
    std::vector<RayResult> results(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const Ray ray = makeRay(lattice, rays[i].origin, rays[i].tMin, rays[i].dir, rays[i].tMax);
            const TraceResult trace = judge(ray);
            results[i] = rayResult(ray, trace.hit, trace.steps, trace.tests);
        }
    });
    return results;
}

void expectSameHits(const std::span<const RayQuery> rays, const std::span<const RayResult> results,
                    const std::span<const RayResult> expected, const Counters counters) {
    expectAgreement(rays, results, expected, [&](const RayResult& a, const RayResult& b) {
        const bool sameHit =
            a.triangleId == b.triangleId &&
            (isMiss(a) || std::bit_cast<std::uint32_t>(a.t) == std::bit_cast<std::uint32_t>(b.t));
        return sameHit && (counters == Counters::ignored || (a.steps == b.steps && a.tests == b.tests));
    });
}

void expectSameOcclusion(const std::span<const RayQuery> rays, const std::span<const RayResult> results,
                         const std::span<const RayResult> expected) {
    expectAgreement(rays, results, expected,
                    [](const RayResult& a, const RayResult& b) { return isMiss(a) == isMiss(b); });
}

} // namespace metamarch::tests
