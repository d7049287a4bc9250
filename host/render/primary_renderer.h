// SPDX-License-Identifier: MIT
// Runs the integrator `primary` on a Vulkan device.
#pragma once
#include "metamarch/reference/rows.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shared/primary.h"

#include <string>
#include <vector>

namespace metamarch::render {

struct PrimaryRender {
    std::vector<FilmPixel> pixels; // camera.width * camera.height, in rows from the top
    double deviceSeconds = 0.0;    // of all submissions but the first
    double firstSeconds = 0.0;     // of the first submission, in which the driver may compile the kernel
    std::uint32_t submissions = 0;
};

// Calls `onProgress` after each submission; if it cancels, the missing pixels are emptyPixel(). Throws
// Error(outOfMemory) if the driver cuts a traversal short.
PrimaryRender renderPrimaryOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                    const std::string& traversal, const Camera& camera,
                                    const OnProgress& onProgress = {});

} // namespace metamarch::render
