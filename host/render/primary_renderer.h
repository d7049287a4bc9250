// SPDX-License-Identifier: MIT
// Runs the integrator `primary` on a Vulkan device.
#pragma once
#include "metamarch/reference/pieces.h"
#include "metamarch/render/device_render.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shared/primary.h"

#include <string>

namespace metamarch::render {

// Calls `onProgress` after each submission; if it cancels, the missing pixels are emptyPixel(). Throws
// Error(outOfMemory) if the driver cuts a traversal short.
DeviceRender renderPrimaryOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                   const std::string& traversal, const Camera& camera,
                                   const OnProgress& onProgress = {});

} // namespace metamarch::render
