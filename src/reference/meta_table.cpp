// SPDX-License-Identifier: MIT
#include "metamarch/reference/meta_table_march.h"
#include "metamarch/reference/twins.h"

namespace metamarch {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traceMetaTable(const AccelerationStructure& scene, const Ray& ray,
                                            const HitQuery query) {
    return marchMetaTable<invariants>(scene, ray, query, [](const MarchTurn&) {});
}

template TraceResult traceMetaTable<Invariants::checked>(const AccelerationStructure&, const Ray&, HitQuery);
template TraceResult traceMetaTable<Invariants::unchecked>(const AccelerationStructure&, const Ray&,
                                                           HitQuery);

namespace meta_table {
namespace {

template <Invariants invariants>
TraceResult traverse(const StructureSet& structures, const Ray& ray, const HitQuery query) {
    return traceMetaTable<invariants>(structures.kdTree(), ray, query);
}

} // namespace

extern const TwinLoop kLoop{traverse<Invariants::checked>, traverse<Invariants::unchecked>};

} // namespace meta_table
} // namespace metamarch
