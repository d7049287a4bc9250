// SPDX-License-Identifier: MIT
// What keys and buttons ask for that changes nothing but the state.
#pragma once
#include "metamarch/viewer/viewer_state.h"
#include "metamarch/vulkan/device_report.h"

namespace metamarch::viewer {

// From the eye to the middle of the scene; 1 where there is none.
float distanceTo(const Bounds& scene, const glm::vec3& eye);

// Where a scene is seen from at first that nobody has asked a camera of: its own first, else all of it.
ViewCamera firstCamera(const LoadedScene& scene, float aspect);

// Only with a scene. False for an action that takes more than the state: printing, saving, reading, quitting.
bool perform(Action action, const vulkan::DeviceReport& device, ViewerState& state);

} // namespace metamarch::viewer
