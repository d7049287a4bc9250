// SPDX-License-Identifier: MIT
#include "metamarch/viewer/renderer.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/eye_media.h"
#include "metamarch/viewer/heat_range.h"
#include "metamarch/vulkan/byte_text.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace metamarch::viewer {

Renderer::Renderer(const vulkan::Device& usedDevice, Presenter& usedPresenter,
                   const std::filesystem::path& shaderFolder)
    : device(usedDevice), presenter(usedPresenter), shaders(shaderFolder), backdrop_(device), view_(device) {}

Renderer::~Renderer() {
    try {
        dropPictures();
    } catch (const std::exception&) {
        // The device is lost; the exception that reported it is already on its way.
    }
}

void Renderer::upload(const render::PreparedScene& scene, ViewerState& state) {
    auto next = std::make_unique<render::DeviceScene>(device, scene);
    dropPictures();
    deviceScene = std::move(next);
    if (device.memoryUse().spilled > 0) { // what the last scene and its pictures took is free now
        deviceScene.reset();
        deviceScene = std::make_unique<render::DeviceScene>(device, scene);
    }
    if (device.memoryUse().spilled > 0) {
        state.say(fmt::format("warning: {} of the scene lie in host memory, which {} reads more slowly",
                              vulkan::byteText(device.memoryUse().spilled), device.name()));
    }
    state.statistics.deviceBytes = deviceScene->bytes();
    isStale = true;
}

void Renderer::followShaders(ViewerState& state) {
    if (deviceScene && shaders.hasChanged()) {
        compileShaders(state);
        if (state.shaderError.empty()) {
            dropPictures();
            isStale = true;
        }
    }
}

void Renderer::compileShaders(ViewerState& state) {
    const std::string error = shaders.compile(state.traversals(), deviceScene->buffers().memoryKind());
    state.shaderError = error;
    state.say(error.empty() ? "shaders compiled anew" : "shader error: " + error.substr(0, error.find('\n')));
}

void Renderer::follow(const Settings& before, const ViewCamera& cameraBefore, ViewerState& state) {
    const Settings& now = state.settings;
    const bool isOtherPicture = cameraBefore != state.camera || before.path != now.path ||
                                before.view != now.view || before.heatMax != now.heatMax ||
                                before.isHeatFitted != now.isHeatFitted || before.samples != now.samples ||
                                before.traversal != now.traversal ||
                                before.secondTraversal != now.secondTraversal;
    isStale = isStale || isOtherPicture;
    isHalted = isHalted && !isStale && haltedSize == state.size;
    if (!deviceScene || isHalted) {
        return;
    }
    const bool areOthers = !view_.areOf(state.traversals(), state.size);
    attempt(state, [&] {
        if (areOthers) {
            presenter.wait();
            if (shaders.lacks(state.traversals())) {
                compileShaders(state);
            }
            view_.make(*deviceScene, state.traversals(), state.size, shaders.overrides(), backdrop_);
        }
        backdrop_.follow(now.backdrop, state.scene->shown.shading, state.traced(), now.tone);
        view_.setTone(now.tone);
        view_.setDenoiser(chosenDenoiser(state));
        view_.setFilter(now.hasFilter);
        view_.setChannel(now.channel);
        if (std::exchange(isStale, false) || areOthers) {
            view_.start(makeRequest(state));
            isHeatKnown = false;
        }
    });
}

RenderRequest Renderer::makeRequest(const ViewerState& state) const {
    RenderRequest request;
    request.camera = sceneCameraOf(state.camera, *state.scene->whole);
    request.lens = lensOf(state.camera);
    request.lens.pixelFilter = state.settings.pixelFilter;
    request.settings = state.settings.path.applied(state.scene->shown.shading->settings);
    request.settings.eyeMedia =
        mediaAt(*state.scene->shown.structure, *state.scene->shown.shading, request.camera.eye);
    request.view = state.settings.view;
    request.endSample = state.settings.samples;
    request.hasPreview = state.settings.hasPreview;
    request.scaleMax = state.settings.heatMax;
    if (request.view && !isHeatMap(*request.view)) {
        const glm::vec2 depths = state.depthRange();
        request.scaleMin = depths[0];
        request.scaleMax = depths[1];
    }
    return request;
}

void Renderer::fitHeat(ViewerState& state) {
    const Settings& settings = state.settings;
    const bool isHeat = settings.view && isHeatMap(*settings.view) && settings.isHeatFitted;
    if (!isHeat || isHeatKnown || isStale || view_.isEmpty() || view_.shown().view != settings.view ||
        !view_.progressive().isWhole()) {
        return;
    }
    isHeatKnown = true;
    state.settings.heatMax = fittingHeat(view_.progressive().shownPixels(), settings.heatMax);
}

const Denoiser* Renderer::chosenDenoiser(ViewerState& state) {
    if (state.settings.isDenoised && !denoiser) {
        try {
            denoiser.emplace();
        } catch (const Error& error) {
            state.settings.isDenoised = false;
            state.say(error.what());
        }
    }
    return state.settings.isDenoised ? &*denoiser : nullptr;
}

bool Renderer::announceKernel(const bool isLoading, ViewerState& state) {
    const bool wasSaid = std::exchange(isKernelSaid_, view_.isBeforeKernel() && !isLoading);
    if (wasSaid != isKernelSaid_ && !isLoading) {
        state.busy = isKernelSaid_ ? "preparing the path tracer; the driver may compile it now" : "";
    }
    return isKernelSaid_ && !wasSaid;
}

bool Renderer::trace(ViewerState& state) {
    bool hasWorked = false;
    if (!view_.isEmpty()) {
        attempt(state, [&] {
            hasWorked = view_.advance();
            view_.update();
        });
    }
    return hasWorked;
}

// Shows the error if the device cannot do the work, and halts until something changes.
void Renderer::attempt(ViewerState& state, const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        if (!device.waitIdle()) { // it is lost
            throw;
        }
        state.say(error.what());
        dropPictures();
        isStale = false;
        isHalted = true;
        haltedSize = state.size;
    }
}

void Renderer::dropPictures() {
    presenter.wait();
    view_.clear();
}

} // namespace metamarch::viewer
