// SPDX-License-Identifier: MIT
// Measures traversals on one scene: on a device and, as CPU twins, in one thread.
#pragma once
#include "metamarch/bench/bench_scene.h"
#include "metamarch/bench/measurement.h"
#include "metamarch/render/scene_buffers.h"

namespace metamarch::bench {

// Each function traces the rays once, compares the hits with the judge's and only then measures. It throws
// Error(mismatch), naming the number of rays that differ, if they differ by more than the tolerance.
Row benchOnDevice(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                  const vulkan::Device& device, const render::SceneBuffers& buffers,
                  const Protocol& protocol);

// `traversal` must have a twin.
Row benchOnCpu(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
               const Protocol& protocol);

// Return the rows kFloor.
Row benchFloorOnDevice(const BenchScene& scene, const JudgedRays& rays, const vulkan::Device& device,
                       const render::SceneBuffers& buffers, const Protocol& protocol);
Row benchFloorOnCpu(const BenchScene& scene, const JudgedRays& rays, const Protocol& protocol);

} // namespace metamarch::bench
