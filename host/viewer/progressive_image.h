// SPDX-License-Identifier: MIT
// One picture of one size that grows: the path tracer's film, or a view of the algorithm.
#pragma once
#include "metamarch/render/device_scene.h"
#include "metamarch/render/inspector.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/render/resolver.h"
#include "metamarch/shading/view.h"
#include "metamarch/viewer/shader_overrides.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::viewer {

// What is to be seen.
struct RenderRequest {
    SceneCamera camera;
    CameraOptions lens;
    PathSettings settings;             // of the path tracer
    std::optional<std::uint32_t> view; // kView…: seen in place of what the path tracer draws
    float scaleMax = 1.0f;             // of the view
    std::uint32_t endSample = 1;       // of the path tracer
};

class ProgressiveImage {
  public:
    // `most`: room on the device for a picture of that width and height. What it is made of must outlive it.
    ProgressiveImage(const vulkan::Device& device, const render::DeviceScene& scene,
                     const std::string& traversal, glm::uvec2 most, const ShaderOverrides& shaders);

    // A picture of at most that size, of which nothing is there yet.
    void start(const RenderRequest& request, glm::uvec2 size);

    // One submission of about `seconds`; false, and nothing is submitted, where nothing is left to do.
    bool advance(double seconds);

    // Every pixel shows something.
    bool isWhole() const;
    // Of the path tracer: the mean over the pixels, and what every pixel has.
    double samples() const;
    std::uint32_t wholeSamples() const { return path->tracer.samples(); }
    // Since start(), on the device.
    double seconds() const;

    void setTone(const ToneMapping& toneMapping);

    // Brings picture() up to what has been done.
    void record(vulkan::Commands& commands);

    const vulkan::Buffer& picture() const;
    glm::uvec2 size() const { return pictureSize; }

    // Of the path tracer since it was made; nothing where it never ran.
    const render::PathCounters* counters() const { return path ? &path->tracer.counters() : nullptr; }

    // The film in rows; of the path tracer.
    std::vector<FilmPixel> film() const;
    // The pixels in rows; of a view.
    std::vector<std::uint32_t> viewPixels() const { return inspector->download(); }

  private:
    struct Path {
        Path(const vulkan::Device& device, const render::DeviceScene& scene, const std::string& traversal,
             std::uint32_t tiles, std::uint32_t pixels, std::span<const std::uint32_t> spirv)
            : tracer(device, scene.buffers(), scene.shading(), traversal, tiles, spirv),
              resolver(device, tracer.film(), pixels) {}

        render::PathTracer tracer;
        render::Resolver resolver;
    };

    void clear();

    const vulkan::Device& device;
    const render::DeviceScene& scene;
    std::string traversal;
    glm::uvec2 most;
    const ShaderOverrides& shaders;
    std::optional<Path> path; // from its first use on
    std::optional<render::Inspector> inspector;

    RenderRequest request;
    glm::uvec2 pictureSize{0};
    ToneMapping tone;
    bool isToClear = false;                    // the picture still shows what was before start()
    std::vector<render::TileRange> unresolved; // of the film
    double secondsBefore = 0.0;                // of the path tracer, at start()
};

} // namespace metamarch::viewer
