// SPDX-License-Identifier: MIT
// Presents pictures and panels in the window.
#pragma once
#include "metamarch/viewer/screen.h"
#include "metamarch/viewer/swapchain.h"
#include "metamarch/viewer/window.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace metamarch::viewer {

// Owns Dear ImGui, which draws the panels over the picture. Context, device and window must outlive it.
class Presenter {
  public:
    Presenter(const vulkan::Context& context, const vulkan::Device& device, Window& window);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Follows the window's size and begins a frame of Dear ImGui. Returns false, and begins no frame, if the
    // window is minimised.
    bool beginFrame();

    // Writes the screen's pixels, and returns what the window shows: these pixels, or others of the same size
    // and order.
    using Paint = std::function<const vulkan::Buffer&(vulkan::Commands&, const Screen&)>;

    // Ends the frame: the panels are drawn over what `paint` returns. Waits for the previous frame.
    void endFrame(const Paint& paint);

    // Asks for a copy of the next frame that is shown, panels included. Returns false if the screen gives
    // none.
    bool keepFrame();
    // Returns the copy once it is there: red, green and blue from the low byte on, rows from the top.
    struct Frame {
        std::vector<std::uint32_t> pixels;
        glm::uvec2 size;
    };
    std::optional<Frame> takeFrame();

    // Waits until the last frame has been drawn. Call it before destroying anything that `paint` used.
    void wait();

    glm::uvec2 size() const { return chain ? chain->size() : glm::uvec2(0); }

  private:
    bool makeChain();
    void startPanels();
    void record(const Paint& paint, std::uint32_t image);
    void recordCopy(std::uint32_t image);
    std::optional<std::uint32_t> acquire();

    const vulkan::Context& context;
    const vulkan::Device& device;
    Window& window;
    vk::raii::SurfaceKHR surface;
    std::optional<Swapchain> chain;
    std::optional<vulkan::Buffer> screen;
    std::optional<vulkan::Buffer> screenBefore; // of the window before its size changed
    glm::uvec2 screenSize{0};
    glm::uvec2 sizeBefore{0};
    bool isScreenEmpty = true;
    bool isFrameWanted = false;
    std::optional<vulkan::Buffer> frame; // the copy of a frame, on its way or there
    glm::uvec2 frameSize{0};
    vk::raii::RenderPass renderPass = nullptr;
    std::vector<vk::raii::Framebuffer> framebuffers; // [image]
    std::vector<vk::raii::Semaphore> drawn;          // [image]
    vk::raii::Semaphore acquired;
    vk::raii::Fence done;
    bool isInFlight = false;
    bool isOutdated = true; // the chain no longer fits the window
    vk::raii::CommandBuffer commandBuffer = nullptr;
    vk::raii::DescriptorPool panelPool = nullptr;
    float textScale = 0.0f;
};

} // namespace metamarch::viewer
