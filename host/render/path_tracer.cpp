// SPDX-License-Identifier: MIT
#include "metamarch/render/path_tracer.h"

#include "metamarch/render/cut_short.h"
#include "metamarch/shared/primary.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <cstring>

namespace metamarch::render {
namespace {

vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const SceneBuffers& scene,
                                     const ShadingBuffers& shading, const std::string& traversal,
                                     const std::span<const std::uint32_t> spirv) {
    vulkan::KernelInfo own{.spirv = spirv,
                           .storageBindings = {kBindInput, kBindOutput, kBindPathStatus},
                           .pushConstantSize = sizeof(PathPush)};
    shading.addTo(own);
    return scene.makePipeline(device, "path", traversal, own);
}

} // namespace

Tiling::Tiling(const Camera& camera)
    : perRow((camera.width + kTileSide - 1) / kTileSide),
      count(perRow * ((camera.height + kTileSide - 1) / kTileSide)) {}

PathTracer::PathTracer(const vulkan::Device& usedDevice, const SceneBuffers& scene,
                       const ShadingBuffers& shading, const std::string& usedTraversal,
                       const std::uint32_t mostTiles, const std::span<const std::uint32_t> spirv)
    : device(usedDevice), traversal(usedTraversal),
      pipeline(makePipeline(usedDevice, scene, shading, usedTraversal, spirv)),
      inputBuffer(usedDevice, vulkan::BufferUse::storage, sizeof(PathInput), "input"),
      filmBuffer(usedDevice, vulkan::BufferUse::storage,
                 std::uint64_t{mostTiles} * kTilePixels * sizeof(FilmPixel), "film"),
      status(usedDevice, vulkan::BufferUse::storage, sizeof(PathStatus), "status"),
      statusReadback(usedDevice, vulkan::BufferUse::readback, sizeof(PathStatus), "status read back"),
      submission(usedDevice), work(mostTiles * kSamplesAtOnce) {
    shading.bindTo(pipeline);
    pipeline.bind(kBindInput, inputBuffer);
    pipeline.bind(kBindOutput, filmBuffer);
    pipeline.bind(kBindPathStatus, status);
}

void PathTracer::start(const Camera& camera, const PathSettings& settings, const TileRange wanted) {
    input = {camera, settings};
    vulkan::write(device, inputBuffer, 0, std::as_bytes(std::span(&input, 1)));
    tiles = wanted;
    tilesPerRow = Tiling(camera).perRow;
    taken = 0;
    passEnd = 0;
    next = tiles.end;
    unfinished = {};
}

double PathTracer::meanSamples() const {
    const double part = static_cast<double>(next - tiles.first) / tiles.count();
    return passEnd > taken ? taken + part * (passEnd - taken) : taken;
}

TileRange PathTracer::advance(const std::uint32_t endSample, const std::uint32_t samplesAtOnce,
                              const double targetSeconds) {
    if (passEnd == taken) {
        passEnd = std::min({taken + samplesAtOnce, taken + fitting, endSample});
        next = tiles.first;
    }
    const std::uint32_t samples = std::max(passEnd - taken, 1u);
    const std::uint32_t most = std::min(tiles.end - next, device.report().maxComputeWorkGroupCount[0]);
    const std::uint32_t count = std::clamp(work.units() / samples, 1u, most);
    const TileRange part = unfinished.count() > 0 ? unfinished : TileRange{next, next + count};
    const double before = sums.deviceSeconds;
    const bool isDone = dispatch(part, passEnd);
    // The last part of a pass is smaller than work.units(); scale its time up to that size.
    const double asked = static_cast<double>(work.units()) / (part.count() * samples);
    work.finished((sums.deviceSeconds - before) * asked, targetSeconds);
    if (!isDone) {
        // Take fewer samples at a time from now on. The next call repeats this part for the missing ones.
        fitting = std::max(fitting / 2, 1u);
        unfinished = part;
        return part;
    }
    unfinished = {};
    next = part.end;
    if (next == tiles.end) {
        taken = passEnd;
    }
    return part;
}

// Returns true if every pixel of the tiles has all its samples.
bool PathTracer::dispatch(const TileRange part, const std::uint32_t endSample) {
    const double seconds = submission.run([&](vulkan::Commands& commands) {
        commands.fill(status, 0);
        commands.dispatch(pipeline, {part.count(), 1, 1},
                          PathPush{part.first, tilesPerRow, endSample, tiles.first,
                                   taken == 0 && unfinished.count() == 0 ? 1u : 0u});
        commands.copy(status, 0, statusReadback, 0, sizeof(PathStatus));
    });
    (sums.submissions++ == 0 ? sums.firstSeconds : sums.deviceSeconds) += seconds;
    PathStatus done{};
    std::memcpy(&done, statusReadback.mapped().data(), sizeof(PathStatus));
    if (done.stuck > 0) {
        refuseCutShort(kCutShort, device, traversal);
    }
    sums.samples += static_cast<double>(part.count()) * kTilePixels * (endSample - taken);
    sums.rays += done.rays;
    sums.steps += done.steps;
    sums.tests += done.tests;
    return done.unfinished == 0;
}

TileRange PathTracer::begunTiles() const {
    return {tiles.first, taken > 0 ? tiles.end : passEnd > 0 ? next : tiles.first};
}

void PathTracer::download(std::vector<FilmPixel>& pixels) const {
    // Read only begun tiles: the others hold data of an earlier film.
    std::vector<FilmPixel> inTiles(std::size_t{begunTiles().count()} * kTilePixels);
    vulkan::read(device, filmBuffer, 0, std::as_writable_bytes(std::span(inTiles)));
    for (std::uint32_t i = 0; i < inTiles.size(); ++i) {
        const std::uint32_t tile = tiles.first + i / kTilePixels;
        const std::uint32_t x = tile % tilesPerRow * kTileSide + i % kTileSide;
        const std::uint32_t y = tile / tilesPerRow * kTileSide + i % kTilePixels / kTileSide;
        if (x < input.camera.width && y < input.camera.height) {
            pixels[std::size_t{y} * input.camera.width + x] = inTiles[i];
        }
    }
}

} // namespace metamarch::render
