// SPDX-License-Identifier: MIT
// Runs a kernel of this folder on the test's device. Binding 0 is read and binding 1 is written, one element
// each per invocation; a workgroup has 64 invocations.
#pragma once
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace metamarch::vulkan {

struct KernelTimes {
    double first = 0.0; // seconds; may include the driver's compilation
    double again = 0.0;
};

template <class Output, class Input>
std::vector<Output>
runKernel(std::span<const uint32_t> spirv, const std::string& name, const std::vector<Input>& inputs,
          std::map<uint32_t, uint32_t> specialization = {}, KernelTimes* times = nullptr) {
    const Device& device = testDevice();
    const Buffer from = upload(device, std::span(inputs), name + " inputs");
    const Buffer to(device, BufferUse::storage, inputs.size() * sizeof(Output), name + " outputs");
    KernelInfo info;
    info.name = name;
    info.spirv = spirv;
    info.storageBindings = {0, 1};
    info.specialization = std::move(specialization);
    ComputePipeline pipeline(device, info);
    pipeline.bind(0, from);
    pipeline.bind(1, to);
    Submission submission(device);
    const GroupCount groups = {static_cast<uint32_t>((inputs.size() + 63) / 64), 1, 1};
    const auto run = [&] {
        return submission.run([&](Commands& commands) { commands.dispatch(pipeline, groups); });
    };
    const double first = run();
    if (times != nullptr) {
        *times = {first, run()};
    }
    return download<Output>(device, to);
}

} // namespace metamarch::vulkan
