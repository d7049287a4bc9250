// The `primary` integrator on a Vulkan device.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/shared/primary.h"

#include <functional>
#include <string>
#include <vector>

namespace metamarch::render {

struct PrimaryRender {
    std::vector<FilmPixel> pixels; // camera.width * camera.height, in rows from the top
    double deviceSeconds = 0.0;    // without the first submission, which may compile
    double firstSeconds = 0.0;     // the first submission
    std::uint32_t submissions = 0;
};

// `onProgress` is told the finished part of the picture, 0..1, after each submission.
PrimaryRender renderPrimary(const vulkan::Device& device, const SceneBuffers& scene,
                            const std::string& traversal, const Camera& camera,
                            const std::function<void(double)>& onProgress);

} // namespace metamarch::render
