// SPDX-License-Identifier: MIT
// Renders a whole picture with the path tracer on a Vulkan device.
#pragma once
#include "metamarch/reference/rows.h"
#include "metamarch/render/device_render.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/shared/path_input.h"

#include <string>

namespace metamarch::render {

// Takes `samples` samples of each pixel, for a film with what `request` asks for. Calls
// `onProgress` after each submission; if it cancels, pixels have fewer samples, or none (emptyPixel()).
// Throws Error(outOfMemory) if the driver cuts a traversal short.
DeviceRender renderPathsOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                 const ShadingBuffers& shading, const std::string& traversal,
                                 const PathSettings& settings, const Camera& camera, std::uint32_t samples,
                                 const FilmRequest& request, const OnProgress& onProgress = {});

} // namespace metamarch::render
