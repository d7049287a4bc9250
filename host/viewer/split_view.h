// SPDX-License-Identifier: MIT
// The window's picture: one viewport, or two side by side.
#pragma once
#include "metamarch/render/stopwatch.h"
#include "metamarch/viewer/stretched_picture.h"
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/viewer/viewport.h"

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace metamarch::viewer {

class SplitView {
  public:
    explicit SplitView(const vulkan::Device& usedDevice) : device(usedDevice), stretched(usedDevice) {}

    bool isEmpty() const { return viewports.empty(); }
    bool areOf(const std::vector<std::string>& traversals, glm::uvec2 windowSize) const;

    // Creates one viewport for each traversal, from left to right. Neither make() nor clear() may be called
    // while the device draws a frame of paint(): see Presenter::wait. Scene, shaders and backdrop must
    // outlive the viewports. Throws what Viewport throws.
    void make(const render::DeviceScene& scene, const std::vector<std::string>& traversals,
              glm::uvec2 windowSize, const ShaderOverrides& shaders, const Backdrop& backdrop);
    // Also call it when scene or shaders change.
    void clear();

    void start(const RenderRequest& request);
    void setTone(const ToneMapping& toneMapping);
    // As those of ProgressiveImage, for the fine pictures.
    void setDenoiser(const Denoiser* denoiser);
    void setFilter(bool isWanted);
    void setChannel(const std::string& name);
    void update();
    bool isDenoising() const;

    // Does the work between two frames: the coarse pictures, as far as the time allows; once they are whole,
    // one submission for each viewport. Returns false if nothing is left to do. Throws what
    // PathTracer::advance throws.
    bool advance();
    // Returns true if that creates the path tracer's kernel, for which a driver may take long. The device
    // keeps the kernels of viewports before, since clear().
    bool isBeforeKernel() const;

    // Writes the screen. `line` is where the left viewport ends, as a fraction of the screen's width. Until
    // new viewports have a picture, the screen keeps the old one, stretched if the window has another size
    // now.
    void paint(vulkan::Commands& commands, const Screen& screen, float line);

    // Returns true if the screen shows the viewports' pictures, from edge to edge.
    bool isShown() const { return hasPicture; }

    // Counts a frame and updates the statistics.
    void measure(Statistics& statistics);

    // The picture of the left viewport, for files. There must be a viewport.
    const ProgressiveImage& progressive() const { return viewports.front()->fineImage(); }
    // The picture of the viewport that shows this column of the screen; `line` as for paint(). There must be
    // a viewport.
    const ProgressiveImage& under(std::uint32_t column, float line) const;
    const RenderRequest& shown() const { return request; }
    const std::string& leftTraversal() const { return viewports.front()->traversal(); }

  private:
    bool isWhole() const;
    void clearPictures();
    bool advance(Viewport& viewport, double seconds);
    void paintBefore(vulkan::Commands& commands, const Screen& screen);
    // Returns the column after the last of this viewport.
    std::uint32_t endOf(std::size_t viewport, float line, std::uint32_t width) const;
    double share(double seconds) const { return seconds / static_cast<double>(viewports.size()); }

    const vulkan::Device& device;
    std::vector<std::unique_ptr<Viewport>> viewports;
    glm::uvec2 size{0};
    bool hasPicture = false; // the viewports have been whole since make()
    StretchedPicture stretched;
    RenderRequest request;
    std::set<std::string> compiled; // traversals with which the path tracer's kernel has been created

    Stopwatch sinceMeasured;
    int frames = 0;                                     // since sinceMeasured was started
    std::array<render::PathCounters, 2> countersBefore; // of the viewports
};

} // namespace metamarch::viewer
