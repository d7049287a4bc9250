// SPDX-License-Identifier: MIT
// A scene that is ready for every backend, and rays with the hits that traversals must find.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/bench/cpu_tracer.h"
#include "metamarch/bench/ray_set.h"
#include "metamarch/bench/row.h"
#include "metamarch/shading/shading.h"

#include <string>
#include <vector>

namespace metamarch::bench {

struct BenchScene {
    // Throws what buildAccelerationStructure throws.
    BenchScene(std::string sceneName, Scene importedScene, const AccelerationOptions& options);
    BenchScene(const BenchScene&) = delete;
    BenchScene& operator=(const BenchScene&) = delete;

    const std::string name;
    const Scene scene;
    const AccelerationStructure structure;
    const ShadingData shading;
    const StructureSet structures{structure}; // for the CPU; the device has a set of its own
};

// Rays and the judge's results for them.
struct JudgedRays {
    std::string name;
    std::string view; // Row::view
    RaySet set;
    Judgement judged;
};

JudgedRays judgeRays(const BenchScene& scene, std::string name, std::string view, RaySet set);

// Returns a row without its speed: names, counts, means over `results`, and the cost of the structure.
Row describeRow(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                const std::string& backend, const std::string& device, std::span<const RayResult> results);

} // namespace metamarch::bench
