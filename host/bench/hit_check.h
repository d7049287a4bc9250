// SPDX-License-Identifier: MIT
// Compares a traversal's hits with the reference's.
#pragma once
#include "metamarch/reference/trace.h"
#include "metamarch/shared/ray_query.h"

#include <cstdint>
#include <span>

namespace metamarch::bench {

// How much hits may differ.
struct HitTolerance {
    float distance = 0.0f; // between two hits of a ray, world units; 0: same bits and same triangle
    double budget = 0.0;   // fraction of the rays that may exceed the distance
};

// Returns the tolerance for a device. If it keeps bits (vulkan::DeviceReport::keepsBits), its hits must equal
// the reference's bit by bit. Vulkan lets other devices divide with an error of 2.5 ulp; their hits may be
// apart by the lattice's kReferenceMargin, and those of 2e-5 of the rays, at silhouettes and edges, by more.
HitTolerance toleranceOn(bool keepsBits, const Lattice& lattice);

// Returns the number of rays whose results differ. For any-hit queries only hit or miss is compared.
std::uint64_t countDifferent(std::span<const RayQuery> rays, std::span<const RayResult> results,
                             std::span<const RayResult> judged, HitQuery query,
                             const HitTolerance& tolerance);

bool isWithinBudget(std::uint64_t different, std::size_t rayCount, const HitTolerance& tolerance);

} // namespace metamarch::bench
