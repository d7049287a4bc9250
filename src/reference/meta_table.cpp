#include "metamarch/reference/meta_table_march.h"

namespace metamarch {

template <Invariants invariants>
[[gnu::flatten]] TraceResult traceMetaTable(const AccelerationStructure& scene, const Ray& ray,
                                            const HitQuery query) {
    return marchMetaTable<invariants>(scene, ray, query, [](const MarchTurn&) {});
}

template TraceResult traceMetaTable<Invariants::checked>(const AccelerationStructure&, const Ray&, HitQuery);
template TraceResult traceMetaTable<Invariants::unchecked>(const AccelerationStructure&, const Ray&,
                                                           HitQuery);

} // namespace metamarch
