// SPDX-License-Identifier: MIT
// Embree on the processor, in one thread, with the same rays: what a mature CPU ray tracer achieves. Built if
// Embree 3 is found; METAMARCH_EMBREE is then defined.
#pragma once
#include "metamarch/bench/bench_scene.h"
#include "metamarch/bench/measurement.h"

#include <memory>
#include <vector>

namespace metamarch::bench {

class EmbreePeer {
  public:
    // Builds Embree's BVH over the scene's triangles with default quality settings.
    explicit EmbreePeer(BenchScene& scene);
    ~EmbreePeer();
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;

    // Returns the rows rtcIntersect1 and rtcIntersect16, or for any-hit queries rtcOccluded1 and
    // rtcOccluded16. Embree uses other arithmetic: Row::differingHits counts the rays that hit in only one of
    // the two, or whose distances differ by more than kTolerance times the lattice's longest side.
    std::vector<Row> bench(const JudgedRays& rays, const Protocol& protocol) const;

    static constexpr float kTolerance = 1e-5f;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace metamarch::bench
