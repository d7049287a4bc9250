// SPDX-License-Identifier: MIT
// Renders the window's picture: begins it again where scene, settings, camera, size or shaders change, and
// lets the device work on it between two frames.
#pragma once
#include "metamarch/render/device_scene.h"
#include "metamarch/viewer/backdrop.h"
#include "metamarch/viewer/presenter.h"
#include "metamarch/viewer/shader_reload.h"
#include "metamarch/viewer/split_view.h"
#include "metamarch/viewer/viewer_state.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace metamarch::viewer {

class Renderer {
  public:
    // The presenter must outlive the renderer, and so must what its frames draw beside the picture.
    Renderer(const vulkan::Device& usedDevice, Presenter& usedPresenter,
             const std::filesystem::path& shaderFolder);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Uploads the scene in place of the one before. Throws Error(outOfMemory) if it does not fit the device.
    void upload(const render::PreparedScene& scene, ViewerState& state);
    // Compiles the shaders if they have changed.
    void followShaders(ViewerState& state);
    // Compares the state with that before and begins again only what a change affects. Here and in trace(),
    // what the device cannot do becomes a message, and then nothing is rendered until a setting or the
    // window's size changes. Throws Error if the device is lost.
    void follow(const Settings& before, const ViewCamera& cameraBefore, ViewerState& state);
    // Chooses the range of a heat map once its picture is whole.
    void fitHeat(ViewerState& state);

    // The frame before the one in which the window waits for the driver says so. Returns true for that frame.
    bool announceKernel(bool isLoading, ViewerState& state);
    bool isKernelSaid() const { return isKernelSaid_; }
    // Returns true if the device has worked.
    bool trace(ViewerState& state);

    // Returns null if noise stays. Loads the library when it is first wanted, and says so if it is not there.
    const Denoiser* chosenDenoiser(ViewerState& state);
    const Backdrop& backdrop() const { return backdrop_; }
    SplitView& view() { return view_; }
    const SplitView& view() const { return view_; }
    std::filesystem::path shaderFolder() const { return shaders.folder(); } // empty: none is watched

  private:
    void compileShaders(ViewerState& state);
    RenderRequest makeRequest(const ViewerState& state) const;
    void attempt(ViewerState& state, const std::function<void()>& work);
    void dropPictures();

    const vulkan::Device& device;
    Presenter& presenter;
    ShaderReload shaders;
    std::optional<Denoiser> denoiser; // loaded on first use
    std::unique_ptr<render::DeviceScene> deviceScene;
    Backdrop backdrop_;
    SplitView view_; // uses the device scene, the denoiser and the backdrop

    bool isKernelSaid_ = false; // ViewerState::busy says that a kernel is made
    bool isStale = false;       // the picture must begin anew
    bool isHeatKnown = false;   // the range of the heat map has been compared with the picture
    bool isHalted = false;      // there is no picture until a setting or the window's size changes
    glm::uvec2 haltedSize{0};
};

} // namespace metamarch::viewer
