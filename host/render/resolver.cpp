// SPDX-License-Identifier: MIT
#include "metamarch/render/resolver.h"

#include "metamarch/render/kernel.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/tile_order.h"

#include <algorithm>
#include <utility>

namespace metamarch::render {
Resolver::Resolver(const vulkan::Device& device, const PathTracer& tracer, const std::uint32_t mostPixels)
    : pictureBuffer(device, vulkan::BufferUse::storage, std::uint64_t{mostPixels} * sizeof(std::uint32_t),
                    "picture"),
      film(tracer.film()) {
    for (const DeviceFilm::Band& band : film.bands()) {
        vulkan::ComputePipeline pipeline =
            makeKernel(device, "resolve",
                       {.storageBindings = {kBindInput, kBindTotal, kBindOutput},
                        .pushConstantSize = sizeof(ResolvePush)});
        pipeline.bind(kBindInput, band.block);
        pipeline.bind(kBindTotal, band.total);
        pipeline.bind(kBindOutput, pictureBuffer);
        pipelines.push_back(std::move(pipeline));
    }
}

void Resolver::resolve(vulkan::Commands& commands, const TileRange tiles, const glm::uvec2 size,
                       const ToneMapping& toneMapping) const {
    const TileOrder order = Tiling(PixelRect{0, 0, size.x, size.y}).order;
    for (std::uint32_t first = tiles.first; first < tiles.end;) {
        const std::uint32_t band = first / film.tilesOfBand();
        const std::uint32_t bandPlace = band * film.tilesOfBand();
        const std::uint32_t end = std::min({tiles.end, first + kMostGroups, bandPlace + film.tilesOfBand()});
        commands.dispatch(pipelines[band], {end - first, 1, 1},
                          ResolvePush{first, order, bandPlace, size.x, size.y, toneMapping.toneOperator,
                                      exposureScale(toneMapping)});
        first = end;
    }
}

} // namespace metamarch::render
