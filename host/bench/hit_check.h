// Whether a traversal found what the judge found.
#pragma once
#include "metamarch/reference/trace.h"
#include "metamarch/shared/ray_query.h"

#include <cstdint>
#include <span>
#include <string>

namespace metamarch::bench {

// How alike hits must be.
struct HitTolerance {
    float distance = 0.0f; // between two hits of a ray in world units; 0: the same bits and triangle
    double budget = 0.0;   // part of the rays that may differ all the same
};

// On lavapipe every bit is the judge's. Other devices may divide within 2.5 ulp (DESIGN.md 3.9): hits may lie
// apart by the lattice's kReferenceMargin, and 2e-5 of the rays, at silhouettes and edges, by more.
HitTolerance toleranceOn(const std::string& driver, const Lattice& lattice);

// Rays whose results differ; of any-hit queries only hit and miss are compared.
std::uint64_t countDifferent(std::span<const RayQuery> rays, std::span<const RayResult> results,
                             std::span<const RayResult> judged, HitQuery query,
                             const HitTolerance& tolerance);

bool isWithinBudget(std::uint64_t different, std::size_t rayCount, const HitTolerance& tolerance);

} // namespace metamarch::bench
