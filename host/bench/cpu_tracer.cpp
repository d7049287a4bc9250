// SPDX-License-Identifier: MIT
#include "metamarch/bench/cpu_tracer.h"

#include "metamarch/reference/triangle_records.h"

#include <tbb/parallel_for.h>

#include <chrono>

namespace metamarch::bench {
namespace {

Ray makeRay(const Lattice& lattice, const RayQuery& query) {
    return metamarch::makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
}

RayResult resultOf(const Ray& ray, const TraceResult& trace) {
    return rayResult(ray, trace.hit, trace.steps, trace.tests);
}

// `traceOne(i)` returns the result of ray i.
template <class TraceOne>
TimedRun runInOneThread(const std::size_t rayCount, const TraceOne& traceOne) {
    TimedRun run{std::vector<RayResult>(rayCount), 0.0};
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rayCount; ++i) {
        run.results[i] = traceOne(i);
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

} // namespace

Judgement judge(const AccelerationStructure& structure, const std::span<const RayQuery> rays,
                const HitQuery query) {
    Judgement judgement{std::vector<RayResult>(rays.size()), std::vector<std::uint32_t>(rays.size())};
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](const std::size_t i) {
        const Ray ray = makeRay(structure.lattice, rays[i]);
        const TraceResult trace = traceKdStack(structure, ray, query);
        judgement.results[i] = resultOf(ray, trace);
        judgement.recordIndices[i] = trace.hit.triangleId == kNoTriangle ? kNoRecord : trace.recordIndex;
    });
    return judgement;
}

TimedRun traceInOneThread(const StructureSet& structures, const std::span<const RayQuery> rays,
                          const HitQuery query, TwinFunction& twin) {
    return runInOneThread(rays.size(), [&](const std::size_t i) {
        const Ray ray = makeRay(structures.kdTree().lattice, rays[i]);
        return resultOf(ray, twin(structures, ray, query));
    });
}

TimedRun traceFloorInOneThread(const AccelerationStructure& structure, const std::span<const RayQuery> rays,
                               const std::span<const std::uint32_t> recordIndices) {
    return runInOneThread(rays.size(), [&](const std::size_t i) {
        const Ray ray = makeRay(structure.lattice, rays[i]);
        TraceResult trace = startTrace(ray);
        if (recordIndices[i] != kNoRecord) {
            testTriangle(structure.triangles, ray, recordIndices[i], trace);
        }
        return resultOf(ray, trace);
    });
}

} // namespace metamarch::bench
