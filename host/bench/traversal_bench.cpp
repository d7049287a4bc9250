// SPDX-License-Identifier: MIT
#include "metamarch/bench/traversal_bench.h"

#include "metamarch/bench/cpu_tracer.h"
#include "metamarch/bench/hit_check.h"
#include "metamarch/error/error.h"
#include "metamarch/render/floor_tracer.h"
#include "metamarch/render/ray_tracer.h"

#include <fmt/format.h>

namespace metamarch::bench {
namespace {

constexpr const char* kOneThread = "one thread";

// Traces on a device and returns the same type as the runs on the CPU.
template <class Tracer>
TimedRun timedRun(Tracer& tracer, const auto&... input) {
    std::vector<RayResult> results = tracer.trace(input...);
    return {std::move(results), tracer.deviceSeconds()};
}

// Returns the row for `run`. Compares its hits with the judge's before it measures.
template <class RunOnce>
Row measuredRow(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                const std::string& backend, const std::string& device, const HitTolerance& tolerance,
                const Protocol& protocol, const RunOnce& run) {
    const std::vector<RayResult> results = run().results;
    const std::uint64_t different =
        countDifferent(rays.set.rays, results, rays.judged.results, rays.set.query, tolerance);
    if (!isWithinBudget(different, results.size(), tolerance)) {
        throw Error(ErrorKind::mismatch,
                    fmt::format("{}, {} rays: {} on {} differs from the judge in {} of {} hits", scene.name,
                                rays.name, traversal, device, different, results.size()));
    }
    Row row = describeRow(scene, rays, traversal, backend, device, results);
    row.differingHits = different;
    const Summary speed = measureMraysPerSecond(protocol, row.rayCount, [&] { return run().seconds; });
    row.mraysPerSecond = speed.median;
    row.spread = speed.spread;
    return row;
}

HitTolerance deviceTolerance(const vulkan::Device& device, const BenchScene& scene) {
    return toleranceOn(device.report().keepsBits(), scene.structure.lattice);
}

} // namespace

Row benchOnDevice(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                  const vulkan::Device& device, const render::SceneBuffers& buffers,
                  const Protocol& protocol) {
    render::RayTracer tracer(device, buffers, traversal, rays.set.query == HitQuery::any);
    return measuredRow(scene, rays, traversal, "gpu", device.name(), deviceTolerance(device, scene), protocol,
                       [&] { return timedRun(tracer, rays.set.rays); });
}

Row benchOnCpu(const BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
               const Protocol& protocol) {
    const TwinLoop& twin = findTwin(traversal);
    return measuredRow(scene, rays, traversal, "cpu", kOneThread, {}, protocol, [&] {
        return traceInOneThread(scene.structures, rays.set.rays, rays.set.query, *twin.unchecked);
    });
}

Row benchFloorOnDevice(const BenchScene& scene, const JudgedRays& rays, const vulkan::Device& device,
                       const render::SceneBuffers& buffers, const Protocol& protocol) {
    render::FloorTracer tracer(device, buffers);
    Row row = measuredRow(scene, rays, kFloor, "gpu", device.name(), deviceTolerance(device, scene), protocol,
                          [&] { return timedRun(tracer, rays.set.rays, rays.judged.recordIndices); });
    compareWithFloor(row, row);
    return row;
}

Row benchFloorOnCpu(const BenchScene& scene, const JudgedRays& rays, const Protocol& protocol) {
    Row row = measuredRow(scene, rays, kFloor, "cpu", kOneThread, {}, protocol, [&] {
        return traceFloorInOneThread(scene.structure, rays.set.rays, rays.judged.recordIndices);
    });
    compareWithFloor(row, row);
    return row;
}

} // namespace metamarch::bench
