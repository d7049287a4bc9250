// SPDX-License-Identifier: MIT
#include "metamarch/python/open_device.h"

#include "metamarch/cli/threads.h"
#include "metamarch/error/error.h"

#include <map>
#include <optional>
#include <unistd.h>

namespace metamarch::python {
namespace {

std::mutex mutex;
std::map<std::string, std::shared_ptr<OpenDevice>>* const devices =
    new std::map<std::string, std::shared_ptr<OpenDevice>>; // outlives every static object

} // namespace

std::shared_ptr<OpenDevice> openDevice(const std::string& selection) {
    const std::scoped_lock lock(mutex);
    std::shared_ptr<OpenDevice>& device = (*devices)[selection];
    if (!device) {
        device = std::make_shared<OpenDevice>(selection);
    }
    return device;
}

void forgetDevice(const std::shared_ptr<OpenDevice>& device) {
    const std::scoped_lock lock(mutex);
    std::erase_if(*devices, [&](const auto& entry) { return entry.second == device; });
}

void closeDevices() {
    const std::scoped_lock lock(mutex);
    devices->clear();
}

void beginWork() {
    const std::scoped_lock lock(mutex);
    static pid_t process = 0;
    if (process == 0) {
        process = getpid();
        new cli::Threads(std::nullopt); // a limit for the whole life of the process
    }
    if (process != getpid()) {
        throw Error(ErrorKind::invalidArgument,
                    "this process was forked off after metamarch had begun to work, and lacks its threads: "
                    "start processes by the method \"spawn\" of multiprocessing");
    }
}

} // namespace metamarch::python
