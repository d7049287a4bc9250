// SPDX-License-Identifier: MIT
#include "metamarch/reference/kd_stack_walk.h"
#include "metamarch/reference/twins.h"

namespace metamarch {

[[gnu::flatten]] TraceResult traceKdStack(const AccelerationStructure& scene, const Ray& ray,
                                          const HitQuery query) {
    return walkKdStack(scene, ray, query, [](const WalkTurn&) {});
}

namespace kd_stack {
namespace {

TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    return traceKdStack(structures.kdTree(), ray, query);
}

} // namespace

extern const TwinLoop kLoop{traverse, traverse};

} // namespace kd_stack
} // namespace metamarch
