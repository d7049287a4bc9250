// SPDX-License-Identifier: MIT
// A picture that is refined step by step: the path tracer's film, or a view of the algorithm.
#pragma once
#include "metamarch/render/device_scene.h"
#include "metamarch/render/display_filter.h"
#include "metamarch/render/inspector.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/render/resolver.h"
#include "metamarch/shading/view.h"
#include "metamarch/viewer/denoised_picture.h"
#include "metamarch/viewer/shader_overrides.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::viewer {

// Describes the picture to draw.
struct RenderRequest {
    SceneCamera camera;
    CameraOptions lens;
    PathSettings settings;             // for the path tracer
    std::optional<std::uint32_t> view; // kView…; none: the path tracer's picture
    float scaleMin = 0.0f;             // for the view: as in InspectPush
    float scaleMax = 1.0f;
    std::uint32_t endSample = 1; // for the path tracer: samples of each pixel
    bool hasPreview = false;     // the view `headlight` is shown until the path tracer has begun
};

class ProgressiveImage {
  public:
    // Pictures have at most `most` pixels in width and height. Device, scene and shaders must outlive it.
    ProgressiveImage(const vulkan::Device& device, const render::DeviceScene& scene,
                     const std::string& traversal, glm::uvec2 most, const ShaderOverrides& shaders);

    // Begins a new, empty picture of `size` pixels. The path tracer's kernel is created by the first
    // advance(), because that takes a driver long.
    void start(const RenderRequest& request, glm::uvec2 size);

    // Continues the picture in one submission of about `seconds`. Returns false, and submits nothing, if the
    // picture is finished.
    bool advance(double seconds);

    // Returns true if the next advance() creates the path tracer's kernel.
    bool isBeforeKernel() const { return !request.view && !path; }

    // Returns true if every pixel shows something.
    bool isWhole() const;
    // Returns true if it is also fit to be seen: the first filtered picture takes a moment.
    bool isReady() const { return isWhole() && (!isFiltered() || filteredSamples > 0); }
    // For the path tracer: samples() is the mean number over the pixels, wholeSamples() the number that every
    // pixel has.
    double samples() const;
    std::uint32_t wholeSamples() const { return path ? path->tracer.samples() : 0; }
    // The time that the path tracer or the view has spent on the device since start().
    double seconds() const;

    void setTone(const ToneMapping& toneMapping);
    // With a denoiser, which must outlive this object, denoise() replaces the path tracer's picture by one
    // without noise.
    void setDenoiser(const Denoiser* usedDenoiser);
    // Filters the path tracer's first samples for the eye, until the picture is finished or has samples
    // enough. A channel or a denoiser takes precedence. Without memory for it, the picture stays as it is.
    void setFilter(bool isWanted);
    // Says why it cannot be filtered; empty: it can, as far as is known.
    std::string_view filterRefusal() const;
    // The name of a row of shownChannels() that replaces the path tracer's picture; empty: none does.
    void setChannel(const std::string& name);
    // Brings channel or denoised picture up to date, each time that the samples have doubled. Call it between
    // two frames. Throws what Denoiser throws.
    void update();
    bool isDenoising() const { return denoised.isWorking(); }

    // Brings picture() up to date with what advance() has done.
    void record(vulkan::Commands& commands);

    // Only for a view, or after the first advance().
    const vulkan::Buffer& picture() const;
    bool hasPicture() const { return request.view ? inspector.has_value() : path.has_value(); }
    glm::uvec2 size() const { return pictureSize; }

    // The path tracer's counters since its construction; null if it has never run.
    const render::PathCounters* counters() const { return path ? &path->tracer.counters() : nullptr; }

    // Returns a pixel of the path tracer's film; one without samples for a view.
    FilmPixel filmPixel(glm::uvec2 place) const;
    // Returns the film. Only for the path tracer's picture.
    FilmData film() const;
    // Returns the packed pixels that are shown, opaque, in rows from the top.
    std::vector<std::uint32_t> shownPixels() const;

  private:
    struct Path {
        Path(const vulkan::Device& device, const render::DeviceScene& scene, const std::string& traversal,
             const Camera& camera, std::uint32_t tiles, std::uint32_t pixels,
             std::span<const std::uint32_t> spirv)
            : tracer(device, scene.buffers(), scene.shading(), traversal, camera, tiles, 0, spirv),
              resolver(device, tracer, pixels) {}

        render::PathTracer tracer;
        render::Resolver resolver;
    };

    void startPath();
    void clear();
    bool isFinished() const;
    bool showsDenoised() const {
        return denoiser != nullptr && channel.empty() && !request.view && !denoised.isEmpty();
    }
    bool isFiltered() const;
    bool showsFiltered() const { return isFiltered() && filteredSamples > 0; }
    bool advanceFilter(double seconds);
    void dropFiltered();
    bool showsChannel() const { return !channel.empty() && !request.view && channelSamples > 0; }
    void showAgain();
    void show(const std::vector<std::uint32_t>& pixels);
    void writeDenoised();
    void writeChannel();

    const vulkan::Device& device;
    const render::DeviceScene& scene;
    std::string traversal;
    glm::uvec2 most;
    const ShaderOverrides& shaders;
    std::optional<Path> path; // created on first use, like the inspector
    std::optional<render::Inspector> inspector;
    std::optional<render::DisplayFilter> filter; // of `path`

    RenderRequest request;
    glm::uvec2 pictureSize{0};
    ToneMapping tone;
    const Denoiser* denoiser = nullptr;
    DenoisedPicture denoised;
    bool hasFilter = false;
    bool hasRoomForFilter = true;      // in the device's memory
    std::uint32_t filteredSamples = 0; // of the film whose filtered picture is shown; 0: none is
    bool isFilterShown = false;        // the picture has it, with these tones
    std::string channel;
    std::uint32_t channelSamples = 0;          // of the film whose channel is shown; 0: the picture is
    bool isToClear = false;                    // the buffer still holds the picture before start()
    std::vector<render::TileRange> unresolved; // tiles of the film that picture() does not show yet
    double secondsBefore = 0.0;                // the path tracer's deviceSeconds at start()
};

} // namespace metamarch::viewer
