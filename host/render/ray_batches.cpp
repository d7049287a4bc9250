// SPDX-License-Identifier: MIT
#include "metamarch/render/ray_batches.h"

#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <optional>

namespace metamarch::render {
namespace {

constexpr std::uint32_t kRaysPerGroup = 64; // local_size_x of the kernels

// The most rays on the device at a time: 2^21 rays are 64 MiB. Every device's maxStorageBufferRange is at
// least 128 MiB.
constexpr std::size_t kBatch = 1u << 21u;

// Kernels that read texel buffers read a ray in texels of 16 bytes. Vulkan guarantees only 65,536 of them;
// devices that are read through storage buffers have more than a batch needs.
std::size_t batchFor(const vulkan::DeviceReport& report) {
    constexpr std::size_t kTexelsOfRay = sizeof(RayQuery) / 16;
    return std::min(kBatch, report.maxTexelBufferElements / kTexelsOfRay);
}

} // namespace

RayBatches::RayBatches(const vulkan::Device& usedDevice, vulkan::ComputePipeline kernelPipeline)
    : device(usedDevice), pipeline(std::move(kernelPipeline)), submission(usedDevice), work(kMostGroups) {}

std::vector<RayResult> RayBatches::run(const std::span<const RayQuery> rays,
                                       const std::span<const std::uint32_t> knownRecords) {
    seconds = 0.0;
    std::vector<RayResult> results;
    results.reserve(rays.size());
    const std::size_t most = batchFor(device.report());
    for (std::size_t first = 0; first < rays.size(); first += most) {
        const std::size_t count = std::min(most, rays.size() - first);
        const std::vector<RayResult> batch =
            runBatch(rays.subspan(first, count),
                     knownRecords.empty() ? knownRecords : knownRecords.subspan(first, count));
        results.insert(results.end(), batch.begin(), batch.end());
    }
    return results;
}

std::vector<RayResult> RayBatches::runBatch(const std::span<const RayQuery> rays,
                                            const std::span<const std::uint32_t> knownRecords) {
    const vulkan::Buffer input = vulkan::upload(device, rays, "rays");
    const vulkan::Buffer output(device, vulkan::BufferUse::storage, rays.size() * sizeof(RayResult), "hits");
    pipeline.bind(kBindInput, input);
    pipeline.bind(kBindOutput, output);
    std::optional<vulkan::Buffer> recordIndices;
    if (!knownRecords.empty()) {
        recordIndices = vulkan::upload(device, knownRecords, "known records");
        pipeline.bind(kBindKnownRecords, *recordIndices);
    }

    const auto end = static_cast<std::uint32_t>(rays.size());
    const std::uint32_t groups = (end + kRaysPerGroup - 1) / kRaysPerGroup;
    for (std::uint32_t group = 0; group < groups;) {
        const std::uint32_t count = std::min(work.units(), groups - group);
        const RaysPush push{group * kRaysPerGroup, end};
        const double spent = submission.run([&](vulkan::Commands& commands) {
            commands.dispatch(pipeline, {count, 1, 1}, push);
        });
        seconds += work.finished(spent);
        group += count;
    }
    return vulkan::download<RayResult>(device, output);
}

} // namespace metamarch::render
