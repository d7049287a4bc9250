#include "reference/twins.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace metamarch {

std::span<const Twin> twins() {
    using Set = StructureSet;
    static constexpr Twin kTwins[] = {
        {"meta_table", [](const Set& scene, const Ray& ray,
                          HitQuery query) { return traceMetaTable(scene.kdTree(), ray, query); }},
        {"kd_stack", [](const Set& scene, const Ray& ray,
                        HitQuery query) { return traceKdStack(scene.kdTree(), ray, query); }},
        {"kd_restart", [](const Set& scene, const Ray& ray,
                          HitQuery query) { return traceKdRestart(scene.kdTree(), ray, query); }},
        {"kd_push_down", [](const Set& scene, const Ray& ray,
                            HitQuery query) { return traceKdPushDown(scene.kdTree(), ray, query); }},
        {"kd_short_stack", [](const Set& scene, const Ray& ray,
                              HitQuery query) { return traceKdShortStack(scene.kdTree(), ray, query); }},
        {"kd_backtrack",
         [](const Set& scene, const Ray& ray, HitQuery query) {
             return traceKdBacktrack(scene.kdTree(), scene.kdParents(), ray, query);
         }},
        {"kd_ropes",
         [](const Set& scene, const Ray& ray, HitQuery query) {
             return traceKdRopes(scene.kdTree(), scene.kdRopes(), ray, query);
         }},
        {"bvh_stack", [](const Set& scene, const Ray& ray,
                         HitQuery query) { return traceBvhStack(scene.bvh(), ray, query); }},
        {"uniform_grid", [](const Set& scene, const Ray& ray,
                            HitQuery query) { return traceUniformGrid(scene.uniformGrid(), ray, query); }},
        {"brute_force", [](const Set& scene, const Ray& ray,
                           HitQuery query) { return traceBruteForce(scene.triangles(), ray, query); }},
    };
    return kTwins;
}

const Twin& findTwin(const std::string_view traversal) {
    const auto found = std::ranges::find(twins(), traversal, &Twin::traversal);
    if (found == twins().end()) {
        throw std::out_of_range("no CPU twin of " + std::string(traversal));
    }
    return *found;
}

} // namespace metamarch
