#include "render/ray_tracer.h"

#include "render/cut_short.h"
#include "vulkan/transfer.h"

namespace metamarch::render {
namespace {

constexpr std::uint32_t kRaysPerGroup = 64; // local_size_x of the kernel

constexpr std::uint32_t kMostGroups = 65535; // the least that maxComputeWorkGroupCount can be

// Rays on the device at a time, within every device's maxStorageBufferRange: 2^22 rays are 128 MiB.
constexpr std::size_t kBatch = 1u << 21u;

} // namespace

RayTracer::RayTracer(const vulkan::Device& usedDevice, const SceneBuffers& scene,
                     const std::string& traversal, const bool anyHit)
    : device(usedDevice), pipeline(scene.makePipeline(usedDevice, "rays", traversal,
                                                      {.storageBindings = {kBindInput, kBindOutput},
                                                       .pushConstantSize = sizeof(RaysPush),
                                                       .specialization = {{kSpecAnyHit, anyHit ? 1u : 0u}}})),
      submission(usedDevice), work(kMostGroups) {}

std::vector<RayResult> RayTracer::trace(const std::span<const RayQuery> rays) {
    seconds = 0.0;
    std::vector<RayResult> results;
    results.reserve(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += kBatch) {
        const std::vector<RayResult> batch =
            traceBatch(rays.subspan(first, std::min(kBatch, rays.size() - first)));
        results.insert(results.end(), batch.begin(), batch.end());
    }
    return results;
}

std::vector<RayResult> RayTracer::traceBatch(const std::span<const RayQuery> rays) {
    const vulkan::Buffer input = vulkan::upload(device, rays, "rays");
    const vulkan::Buffer output(device, vulkan::BufferUse::storage, rays.size() * sizeof(RayResult), "hits");
    pipeline.bind(kBindInput, input);
    pipeline.bind(kBindOutput, output);

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
    std::vector<RayResult> results = vulkan::download<RayResult>(device, output);
    for (const RayResult& result : results) {
        refuseCutShort(result.steps, device, pipeline.name());
    }
    return results;
}

} // namespace metamarch::render
