// SPDX-License-Identifier: MIT
#include "metamarch/render/path_renderer.h"

#include "metamarch/render/path_tracer.h"

#include <algorithm>

namespace metamarch::render {
namespace {

// Tiles on the device at a time: each of the two buffers of their film is 112 MiB, within every device's
// maxStorageBufferRange.
constexpr std::uint32_t kMostTiles = 1u << 14u;

} // namespace

DeviceRender renderPathsOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                 const ShadingBuffers& shading, const std::string& traversal,
                                 const PathSettings& settings, const Camera& camera,
                                 const std::uint32_t samples, const FilmRequest& request,
                                 const OnProgress& onProgress) {
    const std::uint32_t tiles = Tiling(camera).count;
    const std::uint32_t atOnce = std::min(tiles, kMostTiles);
    PathTracer tracer(device, scene, shading, traversal, atOnce, request.parts);
    DeviceRender render;
    render.film = FilmData(std::size_t{camera.width} * camera.height, request.parts);
    bool isOn = true;
    for (std::uint32_t first = 0; isOn && first < tiles; first += atOnce) {
        const TileRange band{first, std::min(first + atOnce, tiles)};
        tracer.start(camera, settings, band);
        while (isOn && tracer.samples() < samples) {
            const std::uint32_t before = tracer.samples();
            tracer.advance(samples, kBlockSamples, WorkSize::kTargetSeconds);
            const bool isBlockWhole = tracer.samples() % kBlockSamples == 0 || tracer.samples() == samples;
            if (!render.film.hits.empty() && tracer.samples() != before && isBlockWhole) {
                tracer.countHits(request.groups, render.film);
            }
            const double part = (first + band.count() * tracer.meanSamples() / samples) / tiles;
            isOn = !onProgress || onProgress(part);
        }
        tracer.download(render.film);
    }
    render.deviceSeconds = tracer.counters().deviceSeconds;
    render.firstSeconds = tracer.counters().firstSeconds;
    render.submissions = tracer.counters().submissions;
    return render;
}

} // namespace metamarch::render
