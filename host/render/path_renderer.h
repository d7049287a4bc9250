// The path tracer on a Vulkan device.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/shared/film.h"
#include "metamarch/shared/path_input.h"

#include <functional>
#include <string>
#include <vector>

namespace metamarch::render {

struct PathRender {
    std::vector<FilmPixel> film; // camera.width * camera.height, in rows from the top
    double deviceSeconds = 0.0;  // without the first submission, which may compile
    double firstSeconds = 0.0;   // the first submission
    std::uint32_t submissions = 0;
};

// `samples` of each pixel. `onProgress` is told the finished part of the picture, 0..1, after each
// submission. Throws Error(outOfMemory) where the driver cuts a traversal short.
PathRender renderPaths(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
                       const std::string& traversal, const PathSettings& settings, const Camera& camera,
                       std::uint32_t samples, const std::function<void(double)>& onProgress);

} // namespace metamarch::render
