// SPDX-License-Identifier: MIT
#include "metamarch/python/open_device.h"

#include "metamarch/cli/threads.h"
#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"

#include <atomic>
#include <map>
#include <optional>
#include <unistd.h>

namespace metamarch::python {
namespace {

std::mutex mutex;
std::map<std::string, std::shared_ptr<OpenDevice>>* const kDevices =
    new std::map<std::string, std::shared_ptr<OpenDevice>>; // outlives every static object
std::atomic<pid_t> worker = 0;                              // the process that has begun to work

} // namespace

bool isForked() {
    const pid_t process = worker;
    return process != 0 && process != getpid();
}

std::shared_ptr<OpenDevice> openDevice(const std::string& selection) {
    const std::scoped_lock lock(mutex);
    std::shared_ptr<OpenDevice>& device = (*kDevices)[selection];
    if (!device) {
        device = std::shared_ptr<OpenDevice>(new OpenDevice(selection), DeleteUnlessForked());
    }
    return device;
}

void forgetDevice(const std::shared_ptr<OpenDevice>& device) {
    const std::scoped_lock lock(mutex);
    std::erase_if(*kDevices, [&](const auto& entry) { return entry.second == device; });
}

void closeDevices() {
    if (isForked()) {
        return;
    }
    const std::scoped_lock lock(mutex);
    kDevices->clear();
}

void beginWork() {
    if (isForked()) {
        throw Error(ErrorKind::invalidArgument,
                    "this process was forked off after metamarch had begun to work, and lacks its threads: "
                    "start processes by the method \"spawn\" of multiprocessing");
    }
    const std::scoped_lock lock(mutex);
    if (worker == 0) {
        worker = getpid();
        new cli::Threads(std::nullopt); // a limit for the whole life of the process
    }
}

void beginFileWork() {
    if (isForked()) {
        forgetImageThreads();
    }
}

} // namespace metamarch::python
