// SPDX-License-Identifier: MIT
// A prepared scene on a device.
#pragma once
#include "metamarch/render/prepared_scene.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/render/stopwatch.h"

#include <cstdint>
#include <optional>

namespace metamarch::render {

// One DeviceScene serves any number of pictures. The device must outlive it.
class DeviceScene {
  public:
    // Throws Error(outOfMemory) if the scene does not fit the device.
    DeviceScene(const vulkan::Device& usedDevice, PreparedScene usedScene);

    const vulkan::Device& device() const { return onDevice; }
    const PreparedScene& scene() const { return prepared; }
    const SceneBuffers& buffers() const { return sceneBuffers; }
    const ShadingBuffers& shading() const { return *shadingBuffers; } // only if scene().shading is set

    double uploadSeconds() const { return seconds; }
    std::uint64_t bytes() const; // device memory in use; grows when pipelines need further structures

  private:
    const vulkan::Device& onDevice;
    PreparedScene prepared;
    Stopwatch upload;
    SceneBuffers sceneBuffers;
    std::optional<ShadingBuffers> shadingBuffers;
    double seconds;
};

} // namespace metamarch::render
