// SPDX-License-Identifier: MIT
// Runs the kernel of the integrator `primary`, on a Vulkan device or on the processor.
#pragma once
#include "metamarch/processor/processor_kernels.h"
#include "metamarch/reference/pieces.h"
#include "metamarch/render/device_render.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shading/shading.h"
#include "metamarch/shared/primary.h"

#include <string>
#include <vector>

namespace metamarch::render {

// Calls `onProgress` after each submission; if it cancels, the missing pixels are emptyPixel(). Throws
// Error(outOfMemory) if the driver cuts a traversal short.
DeviceRender renderPrimaryOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                   const std::string& traversal, const Camera& camera,
                                   const OnProgress& onProgress = {});

// Returns camera.width * camera.height pixels in rows from the top. `kernel` is one of primaryKernels(). If
// `onProgress` cancels, the missing pixels are emptyPixel(). Throws Error(outOfMemory) if an array of the
// structure has more than 4 GiB.
std::vector<FilmPixel> renderPrimaryOnCpu(const AccelerationStructure& structure, const ShadingData& shading,
                                          const Camera& camera, const OnProgress& onProgress = {},
                                          Kernel kernel = primaryKernels().front().run);

} // namespace metamarch::render
