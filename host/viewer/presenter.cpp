// SPDX-License-Identifier: MIT
#include "metamarch/viewer/presenter.h"

#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>

#include <array>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <cstring>
#include <imgui.h>
#include <limits>
#include <utility>

namespace metamarch::viewer {
namespace {

using Access = vk::AccessFlagBits;
using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits;

constexpr std::uint64_t kForever = std::numeric_limits<std::uint64_t>::max();
// The window must answer even if a compositor gives no image back.
constexpr std::uint64_t kAcquireNanoseconds = 100'000'000;

// The render pass draws over the picture that has been copied into the image, and leaves the image in the
// layout for presentation.
vk::raii::RenderPass makeRenderPass(const vulkan::Device& device, const vk::Format format) {
    const vk::AttachmentDescription color({}, format, vk::SampleCountFlagBits::e1,
                                          vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore,
                                          vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                          Layout::eTransferDstOptimal, Layout::ePresentSrcKHR);
    const vk::AttachmentReference reference(0, Layout::eColorAttachmentOptimal);
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, reference);
    const vk::SubpassDependency afterCopy(VK_SUBPASS_EXTERNAL, 0, Stage::eTransfer,
                                          Stage::eColorAttachmentOutput, Access::eTransferWrite,
                                          Access::eColorAttachmentRead | Access::eColorAttachmentWrite);
    return {device.handle(), vk::RenderPassCreateInfo({}, color, subpass, afterCopy)};
}

vk::raii::CommandBuffer makeCommandBuffer(const vulkan::Device& device) {
    vk::raii::CommandBuffers buffers(device.handle(),
                                     {*device.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    return std::move(buffers.front());
}

} // namespace

Presenter::Presenter(const vulkan::Context& usedContext, const vulkan::Device& usedDevice, Window& usedWindow)
    : context(usedContext), device(usedDevice), window(usedWindow),
      surface(usedContext.instance(), usedWindow.makeSurface(*usedContext.instance())),
      acquired(usedDevice.handle(), vk::SemaphoreCreateInfo()),
      done(usedDevice.handle(), vk::FenceCreateInfo()), commandBuffer(makeCommandBuffer(usedDevice)) {
    if (!makeChain()) {
        throw Error(ErrorKind::noDevice, "the window has no size");
    }
    startPanels();
}

Presenter::~Presenter() {
    try {
        device.handle().waitIdle(); // presentation has no fence
    } catch (const vk::SystemError&) {
        // The device is lost, so there is nothing to wait for.
    }
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

// Returns false if the window has no size.
bool Presenter::makeChain() {
    const glm::uvec2 size = window.pixels();
    if (size.x == 0) {
        return false;
    }
    wait();
    device.handle().waitIdle();
    std::optional<Swapchain> next;
    try {
        next.emplace(device, surface, size, chain ? &*chain : nullptr);
    } catch (const vk::SurfaceLostKHRError&) {
        framebuffers.clear();
        chain.reset();
        surface = nullptr;
        surface = {context.instance(), window.makeSurface(*context.instance())};
        next.emplace(device, surface, size, nullptr);
    }
    if (next->isEmpty()) {
        return false; // the surface may know before the window does
    }
    framebuffers.clear();
    drawn.clear();
    chain = std::move(next);
    if (!*renderPass) {
        renderPass = makeRenderPass(device, chain->format());
    }
    for (std::uint32_t i = 0; i < chain->count(); ++i) {
        const vk::ImageView view = chain->view(i);
        framebuffers.emplace_back(
            device.handle(),
            vk::FramebufferCreateInfo({}, *renderPass, view, chain->size().x, chain->size().y, 1));
        drawn.emplace_back(device.handle(), vk::SemaphoreCreateInfo());
    }
    if (screenSize != chain->size()) {
        if (!isScreenEmpty) {
            screenBefore = std::move(screen);
            sizeBefore = screenSize;
        }
        screenSize = chain->size();
        screen.emplace(device, vulkan::BufferUse::storage, std::uint64_t{screenSize.x} * screenSize.y * 4,
                       "screen");
        isScreenEmpty = true;
    }
    isOutdated = false;
    return true;
}

void Presenter::wait() {
    if (!isInFlight) {
        return;
    }
    isInFlight = false;
    try {
        if (device.handle().waitForFences(*done, VK_TRUE, kForever) != vk::Result::eSuccess) {
            throw Error(ErrorKind::noDevice, device.name() + ": device lost");
        }
    } catch (const vk::SystemError& error) {
        throw vulkan::refusalOf(error, fmt::format("{}: device lost", device.name()));
    }
}

void Presenter::startPanels() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // no file is written that the user did not ask for
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 4.0f;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.88f;
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true); // also calls the callbacks that Window has set

    const vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 1);
    panelPool = {device.handle(), vk::DescriptorPoolCreateInfo(
                                      vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *context.instance();
    info.PhysicalDevice = *device.physicalDevice();
    info.Device = *device.handle();
    info.QueueFamily = device.report().computeQueueFamily.value();
    info.Queue = *device.queue();
    info.DescriptorPool = *panelPool;
    info.MinImageCount = 2;
    info.ImageCount = chain->count();
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    ImGui_ImplVulkan_Init(&info, *renderPass);

#if IMGUI_VERSION_NUM >= 19000 // it has a command buffer of its own
    ImGui_ImplVulkan_CreateFontsTexture();
#else
    commandBuffer.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    ImGui_ImplVulkan_CreateFontsTexture(*commandBuffer);
    commandBuffer.end();
    device.queue().submit(vk::SubmitInfo({}, {}, *commandBuffer));
    device.queue().waitIdle();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

bool Presenter::beginFrame() {
    const glm::uvec2 size = window.pixels();
    if (size.x == 0) {
        return false;
    }
    if (isOutdated || !chain || size != chain->size()) {
        try {
            if (!makeChain()) {
                return false;
            }
        } catch (const vk::SystemError& error) {
            throw vulkan::refusalOf(error, fmt::format("{}: no pictures for the window", device.name()));
        }
    }
    // The scale changes when the window moves to another monitor.
    const float scale = window.contentScale();
    if (scale != textScale) {
        ImGui::GetStyle().ScaleAllSizes(textScale == 0.0f ? scale : scale / textScale);
        ImGui::GetIO().FontGlobalScale = scale;
        textScale = scale;
    }
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    return true;
}

// Returns nothing if the swapchain no longer fits the window, or if no image is free in time.
std::optional<std::uint32_t> Presenter::acquire() {
    try {
        const auto [result, image] =
            chain->handle().acquireNextImage(kAcquireNanoseconds, *acquired, nullptr);
        if (result != vk::Result::eSuccess && result != vk::Result::eSuboptimalKHR) {
            return std::nullopt; // the screen has no image free yet, for example while the window is covered
        }
        isOutdated = result == vk::Result::eSuboptimalKHR;
        return image;
    } catch (const vk::OutOfDateKHRError&) {
        isOutdated = true;
    } catch (const vk::SurfaceLostKHRError&) {
        isOutdated = true;
    }
    return std::nullopt;
}

void Presenter::endFrame(const Paint& paint) {
    ImGui::Render();
    try {
        wait();
        const std::optional<std::uint32_t> image = acquire();
        if (!image) {
            return; // the next frame tries again
        }
        record(paint, *image);
        device.handle().resetFences(*done);
        const vk::PipelineStageFlags waitStage = Stage::eTransfer;
        device.queue().submit(vk::SubmitInfo(*acquired, waitStage, *commandBuffer, *drawn[*image]), *done);
        isInFlight = true;
        const vk::Result shown =
            device.queue().presentKHR(vk::PresentInfoKHR(*drawn[*image], *chain->handle(), *image));
        isOutdated = isOutdated || shown == vk::Result::eSuboptimalKHR;
    } catch (const vk::OutOfDateKHRError&) {
        isOutdated = true;
    } catch (const vk::SurfaceLostKHRError&) {
        isOutdated = true;
    } catch (const vk::SystemError& error) {
        throw vulkan::refusalOf(error, fmt::format("{}: cannot show a picture", device.name()));
    }
}

void Presenter::record(const Paint& paint, const std::uint32_t image) {
    const vk::ImageSubresourceRange whole(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    commandBuffer.reset();
    commandBuffer.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    vulkan::Commands commands(device, commandBuffer);
    const vulkan::Buffer& shown =
        paint(commands, {chain->size(), *screen, chain->isBlueFirst(), isScreenEmpty,
                         screenBefore ? &*screenBefore : nullptr, sizeBefore});
    isScreenEmpty = false;

    const vk::MemoryBarrier painted(Access::eShaderWrite | Access::eTransferWrite, Access::eTransferRead);
    const vk::ImageMemoryBarrier toCopy({}, Access::eTransferWrite, Layout::eUndefined,
                                        Layout::eTransferDstOptimal, VK_QUEUE_FAMILY_IGNORED,
                                        VK_QUEUE_FAMILY_IGNORED, chain->image(image), whole);
    commandBuffer.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer, Stage::eTransfer, {}, painted, {},
                                  toCopy);
    const vk::Extent3D extent(chain->size().x, chain->size().y, 1);
    commandBuffer.copyBufferToImage(
        shown.handle(), chain->image(image), Layout::eTransferDstOptimal,
        vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0}, extent));
    commandBuffer.beginRenderPass(vk::RenderPassBeginInfo(*renderPass, *framebuffers[image],
                                                          {{0, 0}, {chain->size().x, chain->size().y}}),
                                  vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), *commandBuffer);
    commandBuffer.endRenderPass();
    if (std::exchange(isFrameWanted, false)) {
        recordCopy(image);
    }
    commandBuffer.end();
}

// Copies what the render pass has drawn.
void Presenter::recordCopy(const std::uint32_t image) {
    frameSize = chain->size();
    frame.emplace(device, vulkan::BufferUse::readback, std::uint64_t{frameSize.x} * frameSize.y * 4, "frame");
    const vk::ImageSubresourceRange whole(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    vk::ImageMemoryBarrier barrier(Access::eColorAttachmentWrite, Access::eTransferRead,
                                   Layout::ePresentSrcKHR, Layout::eTransferSrcOptimal,
                                   VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, chain->image(image),
                                   whole);
    commandBuffer.pipelineBarrier(Stage::eColorAttachmentOutput, Stage::eTransfer, {}, {}, {}, barrier);
    commandBuffer.copyImageToBuffer(chain->image(image), Layout::eTransferSrcOptimal, frame->handle(),
                                    vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                                        {0, 0, 0}, {frameSize.x, frameSize.y, 1}));
    std::swap(barrier.oldLayout, barrier.newLayout);
    barrier.srcAccessMask = barrier.dstAccessMask = {};
    const vk::MemoryBarrier toHost(Access::eTransferWrite, Access::eHostRead);
    commandBuffer.pipelineBarrier(Stage::eTransfer, Stage::eHost | Stage::eBottomOfPipe, {}, toHost, {},
                                  barrier);
}

bool Presenter::keepFrame() {
    isFrameWanted = chain && chain->isReadable();
    return isFrameWanted;
}

std::optional<Presenter::Frame> Presenter::takeFrame() {
    if (!frame) {
        return std::nullopt;
    }
    wait();
    Frame copy{std::vector<std::uint32_t>(std::size_t{frameSize.x} * frameSize.y), frameSize};
    std::memcpy(copy.pixels.data(), frame->mapped().data(), copy.pixels.size() * sizeof(std::uint32_t));
    frame.reset();
    if (chain->isBlueFirst()) {
        for (std::uint32_t& pixel : copy.pixels) {
            pixel = (pixel & 0xff00ff00u) | (pixel & 0xffu) << 16 | (pixel >> 16 & 0xffu);
        }
    }
    return copy;
}

} // namespace metamarch::viewer
