// The CPU twin of every traversal of shaders/traversal: the same algorithm, step for step, with the same
// counters. Twins throw std::logic_error where an invariant of their loop is broken.
#pragma once
#include "accel/structure_set.h"
#include "reference/trace.h"

#include <span>
#include <string_view>

namespace metamarch {

struct Twin {
    std::string_view traversal; // the name in traversals()
    TraceResult (*trace)(const StructureSet& scene, const Ray& ray, HitQuery query);
};

std::span<const Twin> twins();

// Throws std::out_of_range for a traversal without a twin.
const Twin& findTwin(std::string_view traversal);

TraceResult traceKdRestart(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
TraceResult traceKdPushDown(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
TraceResult traceKdShortStack(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
TraceResult traceKdBacktrack(const AccelerationStructure& scene, std::span<const KdParent> parents,
                             const Ray& ray, HitQuery query);
TraceResult traceKdRopes(const AccelerationStructure& scene, std::span<const std::uint32_t> ropes,
                         const Ray& ray, HitQuery query);
TraceResult traceBvhStack(const Bvh& bvh, const Ray& ray, HitQuery query);
TraceResult traceUniformGrid(const UniformGrid& grid, const Ray& ray, HitQuery query);

} // namespace metamarch
