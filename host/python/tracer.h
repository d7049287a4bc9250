// SPDX-License-Identifier: MIT
// Casts rays that a caller in Python gives.
#pragma once
#include "metamarch/python/loaded_scene.h"
#include "metamarch/render/ray_tracer.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace metamarch::python {

// One entry for each ray.
struct Hits {
    std::vector<float> t;               // in lengths of the direction; infinity for a miss
    std::vector<std::int32_t> triangle; // -1 for a miss
    std::vector<glm::vec2> uv; // barycentric weights of the second and the third corner; 0 for a miss
};

class Tracer {
  public:
    // Traces on the cpu if `device` is null.
    Tracer(std::shared_ptr<LoadedScene> scene, std::shared_ptr<OpenDevice> device);
    ~Tracer(); // may wait until another thread has done with the device
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    // Throws what RayTracer::trace or traceOnCpu throws.
    Hits trace(std::span<const RayQuery> rays);

  private:
    std::vector<RayResult> results(std::span<const RayQuery> rays);

    std::shared_ptr<LoadedScene> scene_;
    render::PreparedScene prepared_;
    std::shared_ptr<SceneOnDevice> onDevice_;
    std::unique_ptr<render::RayTracer, DeleteUnlessForked> onDeviceTracer_;
};

} // namespace metamarch::python
