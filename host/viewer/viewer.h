// SPDX-License-Identifier: MIT
// The interactive viewer: `metamarch view`.
#pragma once
#include "metamarch/viewer/viewer_state.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace metamarch::viewer {

struct ViewerOptions {
    SceneRequest scene; // without a file the window is empty until one is dropped on it
    Settings settings;
    bool hasTour = false; // begins with the first screen of tour()
    // Returns a camera that sees the whole scene.
    using FrameAll = std::function<ViewCamera(double verticalFov)>;
    // Returns the camera that the scene is first seen with. Throws Error(invalidArgument) for a camera that
    // the scene does not have.
    std::function<ViewCamera(const Scene& scene, const FrameAll& frameAll)> chooseCamera;
    std::string device;                 // see vulkan::chooseDevice
    glm::uvec2 size{1280, 720};         // of the window, in the screen's units
    std::filesystem::path shaderFolder; // is watched for changes; empty: none
    std::string software;               // name and version, for the headers of pictures
};

// Opens a window and returns when it is closed. Throws Error(noDevice) if there is no display or no device
// that can present to it. Throws the Error of the scene that the options name if that is refused; the window
// shows the errors of later scenes.
void runViewer(const ViewerOptions& options);

} // namespace metamarch::viewer
