// SPDX-License-Identifier: MIT
// The window's picture: one viewport, or two side by side.
#pragma once
#include "metamarch/render/stopwatch.h"
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/viewer/viewport.h"

#include <memory>
#include <string>
#include <vector>

namespace metamarch::viewer {

class SplitView {
  public:
    explicit SplitView(const vulkan::Device& usedDevice) : device(usedDevice) {}

    bool isEmpty() const { return viewports.empty(); }
    bool areOf(const std::vector<std::string>& traversals, glm::uvec2 windowSize) const;

    // One for each traversal, from left to right. Not while a frame that they were painted in is drawn; nor
    // clear(). Scene and shaders must outlive them. Throws as Viewport.
    void make(const render::DeviceScene& scene, const std::vector<std::string>& traversals,
              glm::uvec2 windowSize, const ShaderOverrides& shaders);
    void clear();

    void start(const RenderRequest& request);
    void setTone(const ToneMapping& toneMapping);

    // What fits between two frames: a coarse picture as soon as can be, else one submission for each side.
    // False where nothing is left to do. Throws as PathTracer::advance.
    bool advance();

    // The left side ends at `line`, a part of the screen's width.
    void paint(vulkan::Commands& commands, const Screen& screen, float line);

    // Counts a frame, and brings up to date what is measured.
    void measure(Statistics& statistics);

    // What the left side shows, for files; not where it is empty.
    const ProgressiveImage& progressive() const { return viewports.front()->fineImage(); }
    const RenderRequest& shown() const { return request; }
    const std::string& leftTraversal() const { return viewports.front()->traversal(); }

  private:
    bool isWhole() const;
    double share(double seconds) const { return seconds / static_cast<double>(viewports.size()); }
    render::PathCounters counters() const;

    const vulkan::Device& device;
    std::vector<std::unique_ptr<Viewport>> viewports;
    glm::uvec2 size{0};
    RenderRequest request;

    Stopwatch sinceMeasured;
    int frames = 0; // since then
    render::PathCounters countersBefore;
};

} // namespace metamarch::viewer
