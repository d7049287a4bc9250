// SPDX-License-Identifier: MIT
// What the path tracer reads of a scene, on the device.
#pragma once
#include "metamarch/shared/shading_scene.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/compute_pipeline.h"

#include <cstdint>
#include <map>

namespace metamarch::render {

// Must outlive the pipelines it is bound to.
class ShadingBuffers {
  public:
    // Throws Error(outOfMemory) where it does not fit the device.
    ShadingBuffers(const vulkan::Device& device, const ShadingScene& scene);

    // Adds the bindings that lib/shading.glsl declares, and the features as a specialization constant.
    void addTo(vulkan::KernelInfo& kernel) const;
    void bindTo(vulkan::ComputePipeline& pipeline) const;

    std::uint64_t bytes() const; // on the device

  private:
    std::uint32_t features;
    std::map<std::uint32_t, vulkan::Buffer> buffers; // [binding]
};

} // namespace metamarch::render
