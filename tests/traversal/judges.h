// SPDX-License-Identifier: MIT
// Every way to trace one ray, side by side, for tests.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/trace.h"
#include "metamarch/shared/ray_query.h"

#include <functional>
#include <span>
#include <vector>

namespace metamarch::tests {

using Judge = std::function<TraceResult(const Ray&)>;

// One result per ray, on all processors.
std::vector<RayResult> traceAll(const Lattice& lattice, std::span<const RayQuery> rays, const Judge& judge);

enum class Counters { compared, ignored };

// Fails, naming the first rays, unless every ray has the same triangle at the same t, to the bit, in both.
void expectSameHits(std::span<const RayQuery> rays, std::span<const RayResult> results,
                    std::span<const RayResult> expected, Counters counters);

// The same for any-hit queries, where either may name any triangle: both hit or both miss.
void expectSameOcclusion(std::span<const RayQuery> rays, std::span<const RayResult> results,
                         std::span<const RayResult> expected);

} // namespace metamarch::tests
