// SPDX-License-Identifier: MIT
#include "metamarch/python/tracer.h"

#include "metamarch/render/traversal_choice.h"
#include "metamarch/shared/hit_point.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>
#include <string>
#include <utility>

namespace metamarch::python {
namespace {

Ray rayOf(const AccelerationStructure& structure, const RayQuery& query) {
    return makeRay(structure.lattice, query.origin, query.tMin, query.dir, query.tMax);
}

template <class Each>
void forEachRay(const std::size_t count, const Each& each) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              each(i);
                          }
                      });
}

} // namespace

Tracer::Tracer(std::shared_ptr<LoadedScene> scene, std::shared_ptr<OpenDevice> device)
    : scene_(std::move(scene)), prepared_(scene_->prepared()) {
    if (!device) {
        return;
    }
    useDevice(device, [&] {
        onDevice_ = putOnDevice(device, prepared_);
        onDeviceTracer_.reset(new render::RayTracer(
            device->device, onDevice_->scene.buffers(),
            std::string(render::marchingTraversal(prepared_.structure->options.table)), false));
    });
}

Tracer::~Tracer() {
    if (onDeviceTracer_ && !isForked()) {
        // Its command buffer is of a pool that all work on the device shares.
        const std::scoped_lock lock(onDevice_->owner->inUse);
        onDeviceTracer_.reset();
    }
}

std::vector<RayResult> Tracer::results(const std::span<const RayQuery> rays) {
    if (onDeviceTracer_) {
        return useDevice(onDevice_->owner, [&] { return onDeviceTracer_->trace(rays); });
    }
    return render::traceOnCpu(*prepared_.structure, rays);
}

Hits Tracer::trace(const std::span<const RayQuery> rays) {
    beginWork();
    const std::vector<RayResult> found = results(rays);
    const Scene& scene = scene_->scene();
    Hits hits{std::vector<float>(rays.size(), std::numeric_limits<float>::infinity()),
              std::vector<std::int32_t>(rays.size(), -1),
              std::vector<glm::vec2>(rays.size(), glm::vec2(0.0f))};
    forEachRay(rays.size(), [&](const std::size_t i) {
        if (found[i].triangleId == kNoTriangle) {
            return;
        }
        const glm::uvec3 corners = scene.triangles[found[i].triangleId];
        const Ray ray = rayOf(*prepared_.structure, rays[i]);
        const glm::vec3 weights = cornerWeights(ray, scene.positions[corners.x], scene.positions[corners.y],
                                                scene.positions[corners.z]);
        hits.t[i] = found[i].t;
        hits.triangle[i] = static_cast<std::int32_t>(found[i].triangleId);
        hits.uv[i] = {weights.y, weights.z};
    });
    return hits;
}

} // namespace metamarch::python
