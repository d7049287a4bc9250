// SPDX-License-Identifier: MIT
#include "metamarch/render/path_tracer.h"

#include "metamarch/render/cut_short.h"
#include "metamarch/render/kernel.h"
#include "metamarch/shared/primary.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <cstring>

namespace metamarch::render {
namespace {

bool has(const std::uint32_t parts, const std::uint32_t part) { return (parts & part) != 0; }

vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const SceneBuffers& scene,
                                     const ShadingBuffers& shading, const std::string& traversal,
                                     const std::uint32_t parts, const std::span<const std::uint32_t> spirv) {
    vulkan::KernelInfo own{
        .spirv = spirv,
        .storageBindings = {kBindInput, kBindOutput, kBindPathStatus, kBindTotal, kBindLight, kBindHits},
        .pushConstantSize = sizeof(PathPush),
        .specialization = {{kSpecFilm, parts}}};
    shading.addTo(own);
    return scene.makePipeline(device, "path", traversal, own);
}

// Returns a buffer with `bytes` for each pixel of the tiles. Of a part that the film lacks it has one pixel,
// because a binding needs a buffer.
vulkan::Buffer filmPart(const vulkan::Device& device, const std::uint32_t tiles, const bool isThere,
                        const std::size_t bytes, const char* const name) {
    return {device, vulkan::BufferUse::storage, isThere ? std::uint64_t{tiles} * kTilePixels * bytes : bytes,
            name};
}

// Copies the pixels of tiles as they lie on the device, from the first one of a film on.
template <class T>
std::vector<T> readTiles(const vulkan::Device& device, const vulkan::Buffer& buffer,
                         const std::uint32_t tiles) {
    std::vector<T> values(std::size_t{tiles} * kTilePixels);
    vulkan::read(device, buffer, 0, std::as_writable_bytes(std::span(values)));
    return values;
}

} // namespace

Tiling::Tiling(const Camera& camera)
    : perRow((camera.width + kTileSide - 1) / kTileSide),
      count(perRow * ((camera.height + kTileSide - 1) / kTileSide)) {}

PathTracer::PathTracer(const vulkan::Device& usedDevice, const SceneBuffers& scene,
                       const ShadingBuffers& shading, const std::string& usedTraversal,
                       const std::uint32_t mostTiles, const std::uint32_t usedParts,
                       const std::span<const std::uint32_t> spirv)
    : device(usedDevice), traversal(usedTraversal), parts(usedParts),
      pipeline(makePipeline(usedDevice, scene, shading, usedTraversal, usedParts, spirv)),
      addBlock(makeKernel(usedDevice, "add_block",
                          {.storageBindings = {kBindOutput, kBindTotal, kBindLight, kBindTotalLight},
                           .pushConstantSize = sizeof(AddBlockPush),
                           .specialization = {{kSpecFilm, usedParts}}})),
      inputBuffer(usedDevice, vulkan::BufferUse::storage, sizeof(PathInput), "input"),
      filmBuffer(filmPart(usedDevice, mostTiles, true, sizeof(FilmPixel), "film")),
      totalBuffer(filmPart(usedDevice, mostTiles, true, sizeof(FilmPixel), "film of earlier blocks")),
      lightBuffer(filmPart(usedDevice, mostTiles, has(usedParts, kFilmLight), sizeof(LightParts), "light")),
      totalLightBuffer(filmPart(usedDevice, mostTiles, has(usedParts, kFilmLight), sizeof(LightParts),
                                "light of earlier blocks")),
      hits(filmPart(usedDevice, mostTiles, has(usedParts, kFilmHits), kBlockSamples * sizeof(std::uint32_t),
                    "first hits")),
      status(usedDevice, vulkan::BufferUse::storage, sizeof(PathStatus), "status"),
      statusReadback(usedDevice, vulkan::BufferUse::readback, sizeof(PathStatus), "status read back"),
      submission(usedDevice), work(mostTiles * kBlockSamples) {
    shading.bindTo(pipeline);
    pipeline.bind(kBindInput, inputBuffer);
    pipeline.bind(kBindPathStatus, status);
    for (vulkan::ComputePipeline* const both : {&pipeline, &addBlock}) {
        both->bind(kBindOutput, filmBuffer);
        both->bind(kBindTotal, totalBuffer);
        both->bind(kBindLight, lightBuffer);
    }
    pipeline.bind(kBindHits, hits);
    addBlock.bind(kBindTotalLight, totalLightBuffer);
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
        const std::uint32_t blockEnd = (taken / kBlockSamples + 1) * kBlockSamples;
        passEnd = std::min({taken + samplesAtOnce, taken + fitting, blockEnd, endSample});
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
    const std::uint32_t firstSample = taken / kBlockSamples * kBlockSamples;
    const bool isFresh = taken == firstSample && unfinished.count() == 0;
    const double seconds = submission.run([&](vulkan::Commands& commands) {
        commands.fill(status, 0);
        if (isFresh && firstSample > 0) {
            commands.dispatch(addBlock, {part.count(), 1, 1}, AddBlockPush{part.first - tiles.first});
        }
        commands.dispatch(pipeline, {part.count(), 1, 1},
                          PathPush{part.first, tilesPerRow, firstSample, endSample - firstSample, tiles.first,
                                   isFresh ? 1u : 0u});
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

std::optional<std::size_t> PathTracer::indexOf(const std::uint32_t i) const {
    const std::uint32_t tile = tiles.first + i / kTilePixels;
    const std::uint32_t x = tile % tilesPerRow * kTileSide + i % kTileSide;
    const std::uint32_t y = tile / tilesPerRow * kTileSide + i % kTilePixels / kTileSide;
    if (x >= input.camera.width || y >= input.camera.height) {
        return std::nullopt;
    }
    return std::size_t{y} * input.camera.width + x;
}

void PathTracer::countHits(const std::span<const std::uint32_t> groups, FilmData& film) const {
    const std::uint32_t samples = (taken - 1) % kBlockSamples + 1;
    std::vector<std::uint32_t> triangles(std::size_t{tiles.count()} * kTilePixels * kBlockSamples);
    vulkan::read(device, hits, 0, std::as_writable_bytes(std::span(triangles)));
    for (std::uint32_t i = 0; i < tiles.count() * kTilePixels; ++i) {
        const std::optional<std::size_t> index = indexOf(i);
        for (std::uint32_t sample = 0; index && sample < samples; ++sample) {
            const std::uint32_t triangle = triangles[std::size_t{i} * kBlockSamples + sample];
            if (triangle != kNoTriangle) {
                film.addHit(*index, groups[triangle]);
            }
        }
    }
}

void PathTracer::download(FilmData& film) const {
    // Read only begun tiles: the others hold data of an earlier film.
    const std::uint32_t begun = begunTiles().count();
    const auto blocks = readTiles<FilmPixel>(device, filmBuffer, begun);
    const auto totals = readTiles<FilmPixel>(device, totalBuffer, begun);
    const bool hasLight = has(parts, kFilmLight);
    const auto lights = readTiles<LightParts>(device, lightBuffer, hasLight ? begun : 0);
    const auto totalLights = readTiles<LightParts>(device, totalLightBuffer, hasLight ? begun : 0);
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        if (const std::optional<std::size_t> index = indexOf(i)) {
            film.pixels[*index] = addPixel(totals[i], blocks[i]);
            if (hasLight) {
                film.light[*index] = addPixelLight(totals[i], totalLights[i], lights[i]);
            }
        }
    }
}

} // namespace metamarch::render
