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
    SceneRequest scene;
    Settings settings;
    // Where the first view of a scene is seen from, in a picture of that width / height. Throws
    // Error(invalidArgument) for a camera that the scene does not have.
    std::function<ViewCamera(const Scene& scene, float aspect)> chooseCamera;
    std::string device;                 // --device
    glm::uvec2 size{1280, 720};         // of the window
    std::filesystem::path shaderFolder; // watched for changes; empty: none
    std::string software;               // for the headers of pictures
};

// Opens a window and returns when it is closed. Throws Error(noDevice) without a display or a device that can
// present to it, and whatever refuses the first scene; later ones are refused in the window.
void runViewer(const ViewerOptions& options);

} // namespace metamarch::viewer
