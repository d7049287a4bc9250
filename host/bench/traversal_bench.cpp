#include "bench/traversal_bench.h"

#include "bench/cpu_tracer.h"
#include "bench/hit_check.h"
#include "error.h"
#include "render/ray_tracer.h"

#include <fmt/format.h>

namespace metamarch::bench {
namespace {

constexpr const char* kOneThread = "one thread";

// The row for `results`, whose speed is still to be measured.
Row checkedRow(BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
               const std::string& backend, const std::string& device,
               const std::span<const RayResult> results, const HitTolerance& tolerance) {
    const std::uint64_t different =
        countDifferent(rays.set.rays, results, rays.judged, rays.set.query, tolerance);
    if (!isWithinBudget(different, results.size(), tolerance)) {
        throw Error(ExitCode::comparisonFailed,
                    fmt::format("{}, {} rays: {} on {} differs from the judge in {} of {} hits", scene.name,
                                rays.name, traversal, device, different, results.size()));
    }
    Row row = describeRow(scene, rays, traversal, backend, device, results);
    row.differingHits = different;
    return row;
}

void measure(Row& row, const Protocol& protocol, const std::function<double()>& run) {
    const Summary speed = measureMraysPerSecond(protocol, row.rayCount, run);
    row.mraysPerSecond = speed.median;
    row.spread = speed.spread;
}

} // namespace

Row benchOnDevice(BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
                  const vulkan::Device& device, const render::SceneBuffers& buffers,
                  const Protocol& protocol) {
    render::RayTracer tracer(device, buffers, traversal, rays.set.query == HitQuery::any);
    Row row = checkedRow(scene, rays, traversal, "gpu", device.name(), tracer.trace(rays.set.rays),
                         toleranceOn(device.report().driver, scene.structure.lattice));
    measure(row, protocol, [&] {
        tracer.trace(rays.set.rays);
        return tracer.deviceSeconds();
    });
    return row;
}

Row benchOnCpu(BenchScene& scene, const JudgedRays& rays, const std::string& traversal,
               const Protocol& protocol) {
    const auto run = [&] {
        return traceInOneThread(scene.structures, rays.set.rays, rays.set.query, findTwin(traversal));
    };
    Row row = checkedRow(scene, rays, traversal, "cpu", kOneThread, run().results, HitTolerance{});
    measure(row, protocol, [&] { return run().seconds; });
    return row;
}

} // namespace metamarch::bench
