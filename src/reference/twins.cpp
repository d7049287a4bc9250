#include "metamarch/reference/twins.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace metamarch {
namespace {

using Set = StructureSet;

template <Invariants invariants>
constexpr Twin kTwins[] = {
    {"meta_table", [](const Set& scene, const Ray& ray,
                      HitQuery query) { return traceMetaTable<invariants>(scene.kdTree(), ray, query); }},
    {"rectilinear_table",
     [](const Set& scene, const Ray& ray, HitQuery query) {
         return traceRectilinearTable<invariants>(scene.rectilinearTable(), ray, query);
     }},
    {"kd_stack", [](const Set& scene, const Ray& ray,
                    HitQuery query) { return traceKdStack(scene.kdTree(), ray, query); }},
    {"kd_restart", [](const Set& scene, const Ray& ray,
                      HitQuery query) { return traceKdRestart<invariants>(scene.kdTree(), ray, query); }},
    {"kd_push_down", [](const Set& scene, const Ray& ray,
                        HitQuery query) { return traceKdPushDown<invariants>(scene.kdTree(), ray, query); }},
    {"kd_short_stack",
     [](const Set& scene, const Ray& ray, HitQuery query) {
         return traceKdShortStack<invariants>(scene.kdTree(), ray, query);
     }},
    {"kd_backtrack",
     [](const Set& scene, const Ray& ray, HitQuery query) {
         return traceKdBacktrack<invariants>(scene.kdTree(), scene.kdParents(), ray, query);
     }},
    {"kd_ropes",
     [](const Set& scene, const Ray& ray, HitQuery query) {
         return traceKdRopes<invariants>(scene.kdTree(), scene.kdRopes(), ray, query);
     }},
    {"bvh_stack", [](const Set& scene, const Ray& ray,
                     HitQuery query) { return traceBvhStack<invariants>(scene.bvh(), ray, query); }},
    {"uniform_grid",
     [](const Set& scene, const Ray& ray, HitQuery query) {
         return traceUniformGrid<invariants>(scene.uniformGrid(), ray, query);
     }},
    {"brute_force", [](const Set& scene, const Ray& ray,
                       HitQuery query) { return traceBruteForce(scene.triangles(), ray, query); }},
};

} // namespace

std::span<const Twin> twins(const Invariants invariants) {
    return invariants == Invariants::checked ? std::span<const Twin>(kTwins<Invariants::checked>)
                                             : std::span<const Twin>(kTwins<Invariants::unchecked>);
}

bool hasTwin(const std::string_view traversal) {
    return std::ranges::find(twins(), traversal, &Twin::traversal) != twins().end();
}

const Twin& findTwin(const std::string_view traversal, const Invariants invariants) {
    const std::span<const Twin> all = twins(invariants);
    const auto found = std::ranges::find(all, traversal, &Twin::traversal);
    if (found == all.end()) {
        throw std::out_of_range("no CPU twin of " + std::string(traversal));
    }
    return *found;
}

} // namespace metamarch
