// SPDX-License-Identifier: MIT
// Traces rays with the CPU's traversals and compares the results.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/trace.h"
#include "metamarch/shared/ray_query.h"

#include <functional>
#include <span>
#include <vector>

namespace metamarch::tests {

using Judge = std::function<TraceResult(const Ray&)>;

// Returns one result per ray. Uses all processors.
std::vector<RayResult> traceAll(const Lattice& lattice, std::span<const RayQuery> rays, const Judge& judge);

enum class Counters { compared, ignored };

// Expects that both have the same triangle at the same t, bit by bit, for every ray. Names the first rays for
// which that fails.
void expectSameHits(std::span<const RayQuery> rays, std::span<const RayResult> results,
                    std::span<const RayResult> expected, Counters counters);

// Does the same for any-hit queries: both must hit or both must miss, but each may name any triangle.
void expectSameOcclusion(std::span<const RayQuery> rays, std::span<const RayResult> results,
                         std::span<const RayResult> expected);

} // namespace metamarch::tests
