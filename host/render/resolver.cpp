// SPDX-License-Identifier: MIT
#include "metamarch/render/resolver.h"

#include "metamarch/render/kernel.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/tile_order.h"

#include <algorithm>

namespace metamarch::render {
Resolver::Resolver(const vulkan::Device& device, const PathTracer& tracer, const std::uint32_t mostPixels)
    : pictureBuffer(device, vulkan::BufferUse::storage, std::uint64_t{mostPixels} * sizeof(std::uint32_t),
                    "picture"),
      pipeline(makeKernel(device, "resolve",
                          {.storageBindings = {kBindInput, kBindTotal, kBindOutput},
                           .pushConstantSize = sizeof(ResolvePush)})) {
    pipeline.bind(kBindInput, tracer.film());
    pipeline.bind(kBindTotal, tracer.total());
    pipeline.bind(kBindOutput, pictureBuffer);
}

void Resolver::resolve(vulkan::Commands& commands, const TileRange tiles, const glm::uvec2 size,
                       const ToneMapping& toneMapping) const {
    for (std::uint32_t first = tiles.first; first < tiles.end; first += kMostGroups) {
        const std::uint32_t count = std::min(tiles.end - first, kMostGroups);
        commands.dispatch(pipeline, {count, 1, 1},
                          ResolvePush{first, Tiling(PixelRect{0, 0, size.x, size.y}).order, size.x, size.y,
                                      toneMapping.toneOperator, exposureScale(toneMapping)});
    }
}

} // namespace metamarch::render
