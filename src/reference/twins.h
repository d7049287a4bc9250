// The CPU twins of the traversals of shaders/traversal: the same algorithm, step for step, with the same
// counters. Twins throw std::logic_error where an invariant of their loop is checked and broken.
#pragma once
#include "metamarch/accel/structure_set.h"
#include "metamarch/reference/trace.h"

#include <span>
#include <string_view>

namespace metamarch {

struct Twin {
    std::string_view traversal; // the name in traversals()
    TraceResult (*trace)(const StructureSet& scene, const Ray& ray, HitQuery query);
};

std::span<const Twin> twins(Invariants invariants = Invariants::checked);

// Not those that leave the walk to the driver.
bool hasTwin(std::string_view traversal);

// Throws std::out_of_range for a traversal without a twin.
const Twin& findTwin(std::string_view traversal, Invariants invariants = Invariants::checked);

template <Invariants invariants = Invariants::checked>
TraceResult traceKdRestart(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceKdPushDown(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceKdShortStack(const AccelerationStructure& scene, const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceKdBacktrack(const AccelerationStructure& scene, std::span<const KdParent> parents,
                             const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceKdRopes(const AccelerationStructure& scene, std::span<const std::uint32_t> ropes,
                         const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceBvhStack(const Bvh& bvh, const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceRectilinearTable(const RectilinearTable& scene, const Ray& ray, HitQuery query);
template <Invariants invariants = Invariants::checked>
TraceResult traceUniformGrid(const UniformGrid& grid, const Ray& ray, HitQuery query);

} // namespace metamarch
