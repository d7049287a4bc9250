// SPDX-License-Identifier: MIT
// Shows the scene with one traversal at the window's size: first a coarse picture, then a fine one. With a
// preview, the coarse picture and a sharp one between the two are of the view `headlight`, which has no
// noise.
#pragma once
#include "metamarch/viewer/backdrop.h"
#include "metamarch/viewer/present_kernel.h"
#include "metamarch/viewer/progressive_image.h"
#include "metamarch/viewer/screen.h"

#include <cstdint>
#include <string>

namespace metamarch::viewer {

class Viewport {
  public:
    // `size` is that of the window, in pixels. `backdrop` must outlive it.
    Viewport(const vulkan::Device& device, const render::DeviceScene& scene, const std::string& traversal,
             glm::uvec2 size, const ShaderOverrides& shaders, const Backdrop& backdrop);

    // Begins a new picture. The size of the coarse picture is such that it takes the device about `seconds`.
    void start(const RenderRequest& request, double seconds);
    void setTone(const ToneMapping& toneMapping);
    void setDenoiser(const Denoiser* denoiser) { fine.setDenoiser(denoiser); }
    void setFilter(bool isWanted) { fine.setFilter(isWanted); }
    void setChannel(const std::string& channel) { fine.setChannel(channel); }
    void update() { fine.update(); }

    // Continues in one submission of about `seconds`. Returns false if nothing is left to do.
    bool advance(double seconds);
    // Returns true if that creates the path tracer's kernel.
    bool isBeforeKernel() const;

    // Returns true if every pixel of the window shows something of the request.
    bool isWhole() const { return coarse.isWhole(); }

    // Writes the columns [first, end) of the screen, which may be none. Call it once per frame.
    void record(vulkan::Commands& commands, const Screen& screen, std::uint32_t first, std::uint32_t end);

    const std::string& traversal() const { return name; }
    const ProgressiveImage& fineImage() const { return fine; }
    const ProgressiveImage& coarseImage() const { return coarse; }

  private:
    std::string name;
    glm::uvec2 fineSize;
    ProgressiveImage coarse;
    ProgressiveImage sharp; // the preview at the size of the fine picture
    ProgressiveImage fine;
    PresentKernel presenting;
    PresentKernel presentingOver; // a backdrop
    const Backdrop& backdrop;
    bool hasBackdrop = false; // behind the picture; a view that is chosen has none
    bool hasPreview = false;
    double secondsPerPixel = 0.0; // of the last whole coarse picture; 0: there was none
};

} // namespace metamarch::viewer
