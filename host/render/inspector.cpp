// SPDX-License-Identifier: MIT
#include "metamarch/render/inspector.h"

#include "metamarch/shared/tile_order.h"
#include "metamarch/vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace metamarch::render {
Inspector::Inspector(const vulkan::Device& usedDevice, const SceneBuffers& usedScene,
                     const ShadingBuffers& usedShading, const std::string& usedTraversal,
                     const std::uint32_t roomForPixels, const std::span<const std::uint32_t> ownSpirv,
                     const std::span<const std::uint32_t> ownCellsSpirv)
    : device(usedDevice), scene(usedScene), shading(usedShading), traversal(usedTraversal),
      mostPixels(roomForPixels), camera(usedDevice, vulkan::BufferUse::storage, sizeof(Camera), "camera"),
      pixels(usedDevice, vulkan::BufferUse::storage, std::uint64_t{roomForPixels} * sizeof(std::uint32_t),
             "picture"),
      submission(usedDevice), spirv(ownSpirv.begin(), ownSpirv.end()),
      cellsSpirv(ownCellsSpirv.begin(), ownCellsSpirv.end()) {
    submission.run([&](vulkan::Commands& commands) { commands.fill(pixels, kMissColor); });
}

vulkan::ComputePipeline Inspector::makePipeline(const ViewReads reads) const {
    vulkan::KernelInfo own{.spirv = reads == ViewReads::cells ? cellsSpirv : spirv,
                           .storageBindings = {kBindCamera, kBindOutput},
                           .pushConstantSize = sizeof(InspectPush)};
    const auto bound = [&](vulkan::ComputePipeline pipeline) {
        pipeline.bind(kBindCamera, camera);
        pipeline.bind(kBindOutput, pixels);
        return pipeline;
    };
    if (reads == ViewReads::cells) {
        return bound(scene.makePipeline(device, "cells", "", own));
    }
    shading.addTo(own, kCameraFeatures);
    own.specialization[kSpecParameters] = reads == ViewReads::parameters ? 1 : 0;
    if (reads == ViewReads::hits) {
        own.specialization[kSpecFeatures] = kCameraFeatures;
    }
    vulkan::ComputePipeline pipeline = scene.makePipeline(device, "inspect", traversal, own);
    shading.bindTo(pipeline);
    return bound(std::move(pipeline));
}

void Inspector::start(const Camera& newCamera, const std::uint32_t newView, const float newScaleMax,
                      const float newScaleMin) {
    const std::uint64_t count = std::uint64_t{newCamera.width} * newCamera.height;
    if (count == 0 || count > mostPixels) {
        throw std::invalid_argument(fmt::format("Inspector: a picture of {} x {} pixels, with room for {}",
                                                newCamera.width, newCamera.height, mostPixels));
    }
    if (newView >= kViewNames.size() || !(newScaleMax > newScaleMin)) {
        throw std::invalid_argument(
            fmt::format("Inspector: view {} with scale {} is none", newView, newScaleMax));
    }
    const ViewReads reads = kViewNames[newView].reads;
    auto made = programs.find(reads);
    if (made == programs.end()) {
        made = programs.emplace(reads, Program{makePipeline(reads), WorkSize(kMostGroups)}).first;
    }
    vulkan::write(device, camera, 0, std::as_bytes(std::span(&newCamera, 1)));
    program = &made->second;
    tiling = Tiling(newCamera);
    nextTile = 0;
    view = newView;
    scaleMax = newScaleMax;
    scaleMin = newScaleMin;
    seconds = 0.0;
}

bool Inspector::advance(const double targetSeconds) {
    if (isWhole()) {
        return true;
    }
    const std::uint32_t count = std::min(program->work.units(), tiling.count - nextTile);
    const InspectPush push{nextTile, tiling.order, view, scaleMax, scaleMin};
    const double spent = submission.run([&](vulkan::Commands& commands) {
        commands.dispatch(program->pipeline, {count, 1, 1}, push);
    });
    seconds += program->work.finished(spent, targetSeconds);
    nextTile += count;
    return isWhole();
}

} // namespace metamarch::render
