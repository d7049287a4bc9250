#include "bench/cpu_tracer.h"

#include <tbb/parallel_for.h>

#include <chrono>

namespace metamarch::bench {
namespace {

template <class Trace>
TraceResult traceOne(const Lattice& lattice, const RayQuery& query, const Trace& trace, RayResult& result) {
    const Ray ray = makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
    const TraceResult found = trace(ray);
    result = rayResult(ray, found.hit, found.steps, found.tests);
    return found;
}

} // namespace

std::vector<RayResult> judge(const AccelerationStructure& structure, const std::span<const RayQuery> rays,
                             const HitQuery query, std::vector<std::uint32_t>* const slots) {
    std::vector<RayResult> results(rays.size());
    if (slots != nullptr) {
        slots->resize(rays.size());
    }
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](const std::size_t i) {
        const TraceResult found = traceOne(
            structure.lattice, rays[i], [&](const Ray& ray) { return traceKdStack(structure, ray, query); },
            results[i]);
        if (slots != nullptr) {
            (*slots)[i] = found.slot;
        }
    });
    return results;
}

CpuRun traceInOneThread(const StructureSet& structures, const std::span<const RayQuery> rays,
                        const HitQuery query, const Twin& twin) {
    CpuRun run{std::vector<RayResult>(rays.size()), 0.0};
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        traceOne(
            structures.kdTree().lattice, rays[i],
            [&](const Ray& ray) { return twin.trace(structures, ray, query); }, run.results[i]);
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

} // namespace metamarch::bench
