// SPDX-License-Identifier: MIT
// Puts pictures and panels into the window.
#pragma once
#include "metamarch/viewer/swapchain.h"
#include "metamarch/viewer/window.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/submission.h"

#include <functional>
#include <optional>
#include <vector>

namespace metamarch::viewer {

// The bytes of the window's picture, in rows from the top.
struct Screen {
    glm::uvec2 size; // pixels
    const vulkan::Buffer& pixels;
    bool isBlueFirst; // in memory: blue, green, red, alpha; else red, green, blue, alpha
};

// Owns Dear ImGui, whose panels lie over the picture. What it draws on must outlive it.
class Presenter {
  public:
    Presenter(const vulkan::Context& context, const vulkan::Device& device, Window& window);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Follows the window's size, and begins a frame of Dear ImGui. False where the window shows nothing,
    // being minimised; then there is no frame.
    bool beginFrame();

    // Ends it: `paint` writes the screen's pixels, the panels come on top. Waits for the frame before.
    void endFrame(const std::function<void(vulkan::Commands&, const Screen&)>& paint);

    // Until the last frame has been drawn: before what it was painted with goes away.
    void wait();

    glm::uvec2 size() const { return chain ? chain->size() : glm::uvec2(0); }

  private:
    void makeChain();
    void startPanels();
    void record(const std::function<void(vulkan::Commands&, const Screen&)>& paint, std::uint32_t image);
    std::optional<std::uint32_t> acquire();

    const vulkan::Context& context;
    const vulkan::Device& device;
    Window& window;
    vk::raii::SurfaceKHR surface;
    std::optional<Swapchain> chain;
    std::optional<vulkan::Buffer> screen;
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
