// SPDX-License-Identifier: MIT
#include "metamarch/render/ray_tracer.h"

#include "metamarch/reference/pieces.h"
#include "metamarch/render/cut_short.h"
#include "metamarch/render/processor_input.h"

#include <algorithm>
#include <stdexcept>

namespace metamarch::render {
namespace {

// A thread of the processor takes so many rays at a time: enough that a call of the kernel costs little.
constexpr std::size_t kRaysOfPiece = 1024;

} // namespace

RayTracer::RayTracer(const vulkan::Device& usedDevice, const SceneBuffers& scene,
                     const std::string& usedTraversal, const bool anyHit)
    : device(usedDevice), traversal(usedTraversal),
      batches(usedDevice, scene.makePipeline(usedDevice, "rays", usedTraversal,
                                             {.storageBindings = {kBindOutput},
                                              .texelBindings = {{kBindInput, VK_FORMAT_R32G32B32A32_UINT}},
                                              .pushConstantSize = sizeof(RaysPush),
                                              .specialization = {{kSpecAnyHit, anyHit ? 1u : 0u}}})) {}

std::vector<RayResult> RayTracer::trace(const std::span<const RayQuery> rays) {
    std::vector<RayResult> results = batches.run(rays, {});
    for (const RayResult& result : results) {
        refuseCutShort(result.steps, device, traversal);
    }
    return results;
}

std::vector<RayResult> traceOnCpu(const AccelerationStructure& structure,
                                  const std::span<const RayQuery> rays, const Kernel kernel) {
    const KernelInput input = inputOver(structure);
    std::vector<RayResult> results(rays.size());
    const auto traceOnePiece = [&](const unsigned piece) {
        const std::size_t first = piece * kRaysOfPiece;
        const std::span some = rays.subspan(first, std::min(kRaysOfPiece, rays.size() - first));
        const std::span found = std::span(results).subspan(first, some.size());
        const RaysPush push{0, static_cast<std::uint32_t>(some.size())};
        KernelInput ofPiece = withPush(input, push);
        constexpr unsigned kLanes = KernelInput::kLanes;
        ofPiece.invocations = (push.end + kLanes - 1) / kLanes * kLanes;
        bindValues(ofPiece, kBindInput, some);
        bindOutput(ofPiece, kBindOutput, found.data());
        kernel(ofPiece);
        if (std::ranges::find(found, kCutShort, &RayResult::steps) != found.end()) {
            throw std::logic_error("the kernel of the processor left a ray before its end");
        }
    };
    forEachPiece(static_cast<unsigned>((rays.size() + kRaysOfPiece - 1) / kRaysOfPiece), traceOnePiece, {});
    return results;
}

} // namespace metamarch::render
