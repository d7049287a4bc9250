// SPDX-License-Identifier: MIT
// Measures traversals on one scene: on a device and, as CPU twins, in one thread.
#pragma once
#include "metamarch/bench/bench_scene.h"
#include "metamarch/bench/measurement.h"
#include "metamarch/render/scene_buffers.h"

namespace metamarch::bench {

// All trace the rays once, compare the hits with the judge's and only then measure. They throw
// Error(mismatch), saying how many rays differ, where the hits are not the judge's.
Row benchOnDevice(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                  const vulkan::Device& device, const render::SceneBuffers& buffers,
                  const Protocol& protocol);

// `traversal` must have a twin.
Row benchOnCpu(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
               const Protocol& protocol);

// The rows kFloor.
Row benchFloorOnDevice(const BenchScene& scene, const JudgedRays& rays, const vulkan::Device& device,
                       const render::SceneBuffers& buffers, const Protocol& protocol);
Row benchFloorOnCpu(const BenchScene& scene, const JudgedRays& rays, const Protocol& protocol);

} // namespace metamarch::bench
