// SPDX-License-Identifier: MIT
// The buffers of a scene on the device that the path tracer reads.
#pragma once
#include "metamarch/shared/shading_scene.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/compute_pipeline.h"

#include <cstdint>
#include <map>

namespace metamarch::render {

// Must outlive the pipelines that bindTo() has bound to it.
class ShadingBuffers {
  public:
    // Throws Error(outOfMemory) if the data does not fit the device.
    ShadingBuffers(const vulkan::Device& device, const ShadingScene& scene);

    // Adds the bindings that lib/shading.glsl declares, and as a specialization constant the features of the
    // scene and `ofCamera`, a part of kCameraFeatures.
    void addTo(vulkan::KernelInfo& kernel, std::uint32_t ofCamera) const;
    void bindTo(vulkan::ComputePipeline& pipeline) const;

    std::uint64_t bytes() const; // on the device

  private:
    std::uint32_t features;
    std::map<std::uint32_t, vulkan::Buffer> buffers; // [binding]
};

} // namespace metamarch::render
