// SPDX-License-Identifier: MIT
// The `primary` integrator on a Vulkan device.
#pragma once
#include "metamarch/reference/rows.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shared/primary.h"

#include <string>
#include <vector>

namespace metamarch::render {

struct PrimaryRender {
    std::vector<FilmPixel> pixels; // camera.width * camera.height, in rows from the top
    double deviceSeconds = 0.0;    // without the first submission, which may compile
    double firstSeconds = 0.0;     // the first submission
    std::uint32_t submissions = 0;
};

// `onProgress` is called after each submission. After it cancels, the pixels that are missing hold
// emptyPixel(). Throws Error(outOfMemory) where the driver cuts a traversal short.
PrimaryRender renderPrimaryOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                    const std::string& traversal, const Camera& camera,
                                    const OnProgress& onProgress = {});

} // namespace metamarch::render
