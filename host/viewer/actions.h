// SPDX-License-Identifier: MIT
// Performs the actions of keys and buttons that change only the viewer's state.
#pragma once
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/vulkan/device_report.h"

namespace metamarch::viewer {

// Returns the distance from the eye to the middle of the scene, or 1 if it is 0 or the scene is empty.
float distanceTo(const Bounds& scene, const glm::vec3& eye);

// Returns the camera that a scene is first seen with if the user has not chosen one: the first camera of its
// file, or, if it has none, one that sees the whole scene.
ViewCamera firstCamera(const LoadedScene& scene, const ViewerState& state);

// Returns false for an action that a window without a scene can perform too.
bool needsScene(Action action);

// Performs `action`. Returns false, and does nothing, for an action that needs
// more than the state: printing, saving, reading and quitting.
bool perform(Action action, const vulkan::DeviceReport& device, ViewerState& state);

} // namespace metamarch::viewer
