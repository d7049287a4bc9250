// SPDX-License-Identifier: MIT
// The Vulkan devices that this process has opened. Each stays open for the next picture, with the kernels
// that its driver has compiled.
#pragma once
#include "metamarch/render/device_scene.h"
#include "metamarch/vulkan/device.h"

#include <memory>
#include <mutex>
#include <string>

namespace metamarch::python {

struct OpenDevice {
    explicit OpenDevice(const std::string& selection) : device(context, selection) {}

    vulkan::Context context;
    vulkan::Device device;
    std::mutex inUse; // by one thread at a time
};

// Returns the device that `selection` names, as --device does. Throws Error(noDevice).
std::shared_ptr<OpenDevice> openDevice(const std::string& selection);

// Opens the device anew for the next picture: it was lost.
void forgetDevice(const std::shared_ptr<OpenDevice>& device);

// Lets go of the devices; those that scenes still use stay open.
void closeDevices();

// Throws Error(invalidArgument) in a process that was forked off after metamarch had worked: it has neither
// the threads nor the devices of its parent. The first call in a process also limits the threads, as the
// program does.
void beginWork();

} // namespace metamarch::python
