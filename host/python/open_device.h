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

// Returns true in a process that was forked off after metamarch had worked. It has neither the threads nor
// the devices of its parent; its locks may be held by threads that it lacks. So it takes none.
bool isForked();

// Leaves an object on a device as it is in a forked process: the driver would wait for its threads.
struct DeleteUnlessForked {
    template <class T>
    void operator()(T* const object) const {
        if (!isForked()) {
            delete object;
        }
    }
};

struct OpenDevice {
    explicit OpenDevice(const std::string& selection) : device(context, selection) {}

    vulkan::Context context;
    vulkan::Device device;
    std::mutex inUse; // by one thread at a time
};

// Returns the device that `selection` names, as --device does. Throws Error(noDevice).
std::shared_ptr<OpenDevice> openDevice(const std::string& selection);

// Opens the device anew for the next picture.
void forgetDevice(const std::shared_ptr<OpenDevice>& device);

// Runs `work` while no other thread uses the device, and returns its result. A device whose work fails may be
// lost, and is forgotten.
template <class Work>
auto useDevice(const std::shared_ptr<OpenDevice>& device, const Work& work) {
    const std::scoped_lock lock(device->inUse);
    try {
        return work();
    } catch (...) {
        forgetDevice(device);
        throw;
    }
}

// Lets go of the devices; those that scenes still use stay open.
void closeDevices();

// Throws Error(invalidArgument) in a forked process. The first call in a process also limits the threads, as
// the program does.
void beginWork();

// Limits a forked process to its only thread. For what works there too: files and pixels of films that are
// done.
void beginFileWork();

} // namespace metamarch::python
