// Embree on the processor, one thread, the same rays: what a grown CPU ray tracer makes of them. Built where
// Embree 3 is found, METAMARCH_EMBREE then being defined.
#pragma once
#include "metamarch/bench/bench_scene.h"
#include "metamarch/bench/measurement.h"

#include <memory>
#include <vector>

namespace metamarch::bench {

class EmbreePeer {
  public:
    // Builds Embree's BVH over the scene's triangles, with its settings of quality as they come.
    explicit EmbreePeer(BenchScene& scene);
    ~EmbreePeer();
    EmbreePeer(const EmbreePeer&) = delete;
    EmbreePeer& operator=(const EmbreePeer&) = delete;

    // Rows rtcIntersect1 and rtcIntersect16, of any-hit queries rtcOccluded1 and rtcOccluded16. Embree's
    // arithmetic is its own: Row::differingHits counts the rays that hit only here or there, or at distances
    // more than kTolerance of the lattice's longest side apart.
    std::vector<Row> bench(const JudgedRays& rays, const Protocol& protocol) const;

    static constexpr float kTolerance = 1e-5f;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace metamarch::bench
