// SPDX-License-Identifier: MIT
#include "metamarch/render/path_tracer.h"

#include "metamarch/render/cut_short.h"
#include "metamarch/render/kernel.h"
#include "metamarch/shared/features.h"
#include "metamarch/shared/tile_order.h"
#include "metamarch/shared/triangle.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace metamarch::render {
namespace {

constexpr std::size_t kOutside = std::numeric_limits<std::size_t>::max();

double valueOf(const Count count) { return count.low + 0x1p32 * count.high; }

bool has(const std::uint32_t parts, const std::uint32_t part) { return (parts & part) != 0; }

} // namespace

PathTracer::PathTracer(const vulkan::Device& usedDevice, const SceneBuffers& usedScene,
                       const ShadingBuffers& usedShading, const std::string& usedTraversal,
                       const Camera& firstCamera, const std::uint32_t mostTiles,
                       const std::uint32_t usedParts, const std::span<const std::uint32_t> usedSpirv,
                       const std::uint32_t firstTurns, const std::uint32_t mostTilesOfBand)
    : device(usedDevice), scene(usedScene), shading(usedShading), traversal(usedTraversal), parts(usedParts),
      spirv(usedSpirv),
      addBlock(makeKernel(usedDevice, "add_block",
                          {.storageBindings = {kBindOutput, kBindTotal, kBindLight, kBindTotalLight},
                           .pushConstantSize = sizeof(AddBlockPush),
                           .specialization = {{kSpecFilm, usedParts}}})),
      inputBuffer(usedDevice, vulkan::BufferUse::storage, sizeof(PathInput), "input"),
      deviceFilm(usedDevice, mostTiles, usedParts, mostTilesOfBand),
      status(usedDevice, vulkan::BufferUse::storage, sizeof(PathStatus), "status"),
      statusReadback(usedDevice, vulkan::BufferUse::readback, sizeof(PathStatus), "status read back"),
      submission(usedDevice), work(mostTiles * kBlockSamples), turns(firstTurns) {
    preparePipeline(cameraFeatures(firstCamera));
}

// Makes the pipeline for cameras with these features, unless it is the one for them.
void PathTracer::preparePipeline(const std::uint32_t wantedFeatures) {
    if (pipeline && pipelineFeatures == wantedFeatures) {
        return;
    }
    vulkan::KernelInfo own{
        .spirv = spirv,
        .storageBindings = {kBindInput, kBindOutput, kBindPathStatus, kBindTotal, kBindLight, kBindHits},
        .pushConstantSize = sizeof(PathPush),
        .specialization = {{kSpecFilm, parts}}};
    shading.addTo(own, wantedFeatures);
    pipeline.emplace(scene.makePipeline(device, "path", traversal, own));
    pipelineFeatures = wantedFeatures;
    shading.bindTo(*pipeline);
    pipeline->bind(kBindInput, inputBuffer);
    pipeline->bind(kBindPathStatus, status);
    bindBand(boundBand);
}

// No submission may be running.
void PathTracer::bindBand(const std::size_t band) {
    const DeviceFilm::Band& film = deviceFilm.bands()[band];
    for (vulkan::ComputePipeline* const both : {&*pipeline, &addBlock}) {
        both->bind(kBindOutput, film.block);
        both->bind(kBindTotal, film.total);
        both->bind(kBindLight, film.blockLight);
    }
    pipeline->bind(kBindHits, film.hits);
    addBlock.bind(kBindTotalLight, film.totalLight);
    boundBand = band;
}

void PathTracer::start(const Camera& camera, const PathSettings& settings, const TileRange wanted) {
    start(camera, settings, {0, 0, camera.width, camera.height}, wanted, 0);
}

void PathTracer::start(const Camera& camera, const PathSettings& settings, const PixelRect& wantedArea,
                       const TileRange wanted, const std::uint32_t firstSample) {
    preparePipeline(cameraFeatures(camera));
    area = wantedArea;
    input = {camera, settings, area.left, area.top, area.width(), area.height()};
    vulkan::write(device, inputBuffer, 0, std::as_bytes(std::span(&input, 1)));
    tiles = wanted;
    order = Tiling(area).order;
    filmFirst = firstSample;
    blockFirst = firstSample;
    hasSums = false;
    taken = firstSample;
    passEnd = firstSample;
    next = tiles.end;
    unfinished = {};
    if (firstSample > 0) { // with sample 0 the kernel does it
        submission.run([&](vulkan::Commands& commands) {
            for (const DeviceFilm::Band& band : deviceFilm.bands()) {
                commands.fill(band.total, 0);
            }
        });
    }
}

double PathTracer::meanSamples() const {
    const double whole = static_cast<double>(next - tiles.first) * (passEnd - taken);
    const double ofPart = unfinished.count() * (static_cast<double>(unfinishedTaken) - taken);
    return passEnd > taken ? taken + (whole + ofPart) / tiles.count() : taken;
}

TileRange PathTracer::advance(const std::uint32_t endSample, const std::uint32_t samplesAtOnce,
                              const double targetSeconds) {
    if (passEnd == taken) {
        if (taken > blockFirst && taken % kBlockSamples == 0) {
            blockFirst = taken;
            hasSums = false;
        }
        const std::uint32_t blockEnd = (taken / kBlockSamples + 1) * kBlockSamples;
        passEnd = std::min({taken + samplesAtOnce, taken + fitting, blockEnd, endSample});
        next = tiles.first;
    }
    const std::uint32_t samples = std::max(passEnd - taken, 1u);
    // A dispatch writes one band.
    const std::uint32_t ofBand = deviceFilm.tilesOfBand() - (next - tiles.first) % deviceFilm.tilesOfBand();
    const std::uint32_t most =
        std::min({tiles.end - next, ofBand, device.report().maxComputeWorkGroupCount[0]});
    const std::uint32_t count = std::clamp(work.units() / samples, 1u, most);
    const bool isNew = unfinished.count() == 0;
    const TileRange part = isNew ? TileRange{next, next + count} : unfinished;
    const std::uint32_t begin = isNew ? taken : unfinishedTaken;
    // A tile that takes longer than a submission should gets some samples at a time. With uploaded sums a
    // tile may already have all of them, which takes no time.
    const bool isSplit = part.count() == 1 && !hasSums;
    const std::uint32_t end = isSplit ? std::min(passEnd, begin + work.units()) : passEnd;
    const double before = sums.deviceSeconds;
    const double raysBefore = sums.rays;
    const Outcome outcome = dispatch(part, begin, std::max(end, begin));
    // The last part of a pass is smaller than work.units(); scale its time up to that size.
    const double asked = static_cast<double>(work.units()) / (part.count() * std::max(end - begin, 1u));
    if (sums.rays > raysBefore) { // with uploaded sums, tiles may have all their samples
        work.finished((sums.deviceSeconds - before) * asked, targetSeconds);
    }
    if (outcome == Outcome::stuck) {
        turns = turns > kMostTurns / kMoreTurns ? kMostTurns : turns * kMoreTurns;
    }
    if (outcome == Outcome::cutByDriver) {
        // Take fewer samples at a time from now on. The next call repeats this part for the missing ones.
        fitting = std::max(fitting / 2, 1u);
    }
    unfinishedTaken = outcome == Outcome::whole ? end : begin;
    if (outcome != Outcome::whole || end < passEnd) {
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

// Takes the samples of the tiles up to endSample. Every pixel has those before firstSample.
PathTracer::Outcome PathTracer::dispatch(const TileRange part, const std::uint32_t firstSample,
                                         const std::uint32_t endSample) {
    const bool isFresh = taken == blockFirst && unfinished.count() == 0 && !hasSums;
    const std::uint32_t band = (part.first - tiles.first) / deviceFilm.tilesOfBand();
    const std::uint32_t bandPlace = tiles.first + band * deviceFilm.tilesOfBand();
    if (band != boundBand) {
        bindBand(band);
    }
    const double seconds = submission.run([&](vulkan::Commands& commands) {
        commands.fill(status, 0);
        if (isFresh && blockFirst > filmFirst) {
            commands.dispatch(addBlock, {part.count(), 1, 1}, AddBlockPush{part.first - bandPlace});
        }
        commands.dispatch(*pipeline, {part.count(), 1, 1},
                          PathPush{part.first, order, blockFirst, endSample - blockFirst, bandPlace,
                                   isFresh ? 1u : 0u, turns});
        commands.copy(status, 0, statusReadback, 0, sizeof(PathStatus));
    });
    (sums.submissions++ == 0 ? sums.firstSeconds : sums.deviceSeconds) += seconds;
    PathStatus done{};
    std::memcpy(&done, statusReadback.mapped().data(), sizeof(PathStatus));
    if (done.stuck > 0 && done.outOfTurns == 0) {
        refuseCutShort(kCutShort, device, traversal);
    }
    const Outcome outcome = done.unfinished == 0                ? Outcome::whole
                            : done.stuck > 0                    ? Outcome::stuck
                            : done.unfinished > done.outOfTurns ? Outcome::cutByDriver
                                                                : Outcome::outOfTurns;
    if (outcome == Outcome::whole) {
        sums.samples += static_cast<double>(part.count()) * kTilePixels * (endSample - firstSample);
    }
    sums.rays += valueOf(done.rays);
    sums.steps += valueOf(done.steps);
    sums.tests += valueOf(done.tests);
    return outcome;
}

TileRange PathTracer::begunTiles() const {
    const bool isBegun = taken > filmFirst || hasSums;
    return {tiles.first, isBegun               ? tiles.end
                         : passEnd > filmFirst ? std::max(next, unfinished.end)
                                               : tiles.first};
}

// The arrays of the begun tiles, as they lie on the device.
struct PathTracer::TileSums {
    std::vector<FilmPixel> blocks;
    std::vector<FilmPixel> totals;
    std::vector<LightParts> lights; // none without kFilmLight
    std::vector<LightParts> totalLights;

    // Puts the sums of pixel i into a film. Those of the block alone have no samples before them.
    void copyTotal(const std::size_t i, FilmData& film, const std::size_t index) const {
        if (film.pixels.empty()) {
            return; // nobody wants them
        }
        film.pixels[index] = totals[i].samples > 0 ? totals[i] : emptyPixel();
        if (!film.light.empty()) {
            film.light[index] = totals[i].samples > 0 ? totalLights[i] : noLight();
        }
    }
    void copyBlock(const std::size_t i, FilmData& film, const std::size_t index) const {
        film.pixels[index] = blocks[i];
        if (!film.light.empty()) {
            film.light[index] = lights[i];
        }
    }
    void copySum(const std::size_t i, FilmData& film, const std::size_t index) const {
        film.pixels[index] = addPixel(totals[i], blocks[i]);
        if (!film.light.empty()) {
            film.light[index] = addPixelLight(totals[i], totalLights[i], lights[i]);
        }
    }
};

PathTracer::TileSums PathTracer::readSums() const {
    const std::uint32_t begun = begunTiles().count();
    const std::uint32_t lit = has(parts, kFilmLight) ? begun : 0;
    return {deviceFilm.read<FilmPixel>(&DeviceFilm::Band::block, begun),
            deviceFilm.read<FilmPixel>(&DeviceFilm::Band::total, begun),
            deviceFilm.read<LightParts>(&DeviceFilm::Band::blockLight, lit),
            deviceFilm.read<LightParts>(&DeviceFilm::Band::totalLight, lit)};
}

// The place in a film of the area of pixel i of the tiles; kOutside for one that is only in the tile.
std::size_t PathTracer::indexInArea(const std::uint32_t i) const {
    const std::uint32_t tile = tileAt(order, tiles.first + i / kTilePixels);
    const uvec2 corner = uvec2(tile % order.perRow, tile / order.perRow) * kTileSide;
    const uvec2 pixel = corner + pixelInTile(i % kTilePixels);
    return pixel.x < area.width() && pixel.y < area.height() ? std::size_t{pixel.y} * area.width() + pixel.x
                                                             : kOutside;
}

// The inverse of tileAt().
std::uint32_t PathTracer::placeOfTile(const std::uint32_t row, const std::uint32_t column) const {
    std::uint32_t i = 0;
    while (i * order.rowStride % order.rows != row) {
        ++i;
    }
    const std::uint32_t shift = i * order.columnStride % order.perRow;
    return (column + order.perRow - shift) % order.perRow * order.rows + i;
}

FilmPixel PathTracer::pixel(const std::uint32_t x, const std::uint32_t y) const {
    const std::uint32_t place = placeOfTile(y / kTileSide, x / kTileSide);
    const TileRange begun = begunTiles();
    if (x >= area.width() || y >= area.height() || place < begun.first || place >= begun.end) {
        return emptyPixel();
    }
    const std::uint32_t tile = place - tiles.first;
    const DeviceFilm::Band& band = deviceFilm.bands()[tile / deviceFilm.tilesOfBand()];
    const std::uint64_t index =
        std::uint64_t{tile % deviceFilm.tilesOfBand()} * kTilePixels + placeInTile(x, y);
    std::array<FilmPixel, 2> pair;
    vulkan::read(device, band.total, index * sizeof(FilmPixel),
                 std::as_writable_bytes(std::span(pair).first(1)));
    vulkan::read(device, band.block, index * sizeof(FilmPixel),
                 std::as_writable_bytes(std::span(pair).last(1)));
    return addPixel(pair[0], pair[1]);
}

void PathTracer::download(FilmData& film) const {
    const TileSums read = readSums();
    for (std::uint32_t i = 0; i < read.blocks.size(); ++i) {
        if (const std::size_t index = indexInArea(i); index != kOutside) {
            read.copySum(i, film, index);
        }
    }
}

std::uint32_t PathTracer::downloadSums(FilmData& earlier, FilmData& block,
                                       const std::span<const std::uint32_t> groups) const {
    const TileSums read = readSums();
    const bool countsHits = has(parts, kFilmHits) && !groups.empty();
    const auto triangles = deviceFilm.read<std::array<std::uint32_t, kBlockSamples>>(
        &DeviceFilm::Band::hits, countsHits ? begunTiles().count() : 0);
    // Where the pass has not come yet, the last block is the one before.
    const bool isFirstPass = passEnd > taken && taken == blockFirst && blockFirst > filmFirst && !hasSums;
    const std::uint32_t reached = isFirstPass ? std::max(next, unfinished.end) : tiles.end;
    for (std::uint32_t i = 0; i < read.blocks.size(); ++i) {
        const std::size_t index = indexInArea(i);
        if (index == kOutside) {
            continue;
        }
        if (tiles.first + i / kTilePixels < reached) {
            for (std::uint32_t sample = block.pixels[index].samples;
                 countsHits && sample < read.blocks[i].samples; ++sample) {
                if (triangles[i][sample] != kNoTriangle) {
                    block.addHit(index, groups[triangles[i][sample]]);
                }
            }
            read.copyTotal(i, earlier, index);
            read.copyBlock(i, block, index);
        } else {
            read.copySum(i, earlier, index);
        }
    }
    return blockFirst;
}

void PathTracer::upload(const FilmData& earlier, const FilmData& block) {
    TileSums written;
    const std::size_t count = std::size_t{tiles.count()} * kTilePixels;
    const std::size_t lit = has(parts, kFilmLight) ? count : 0;
    written.blocks.assign(count, emptyPixel());
    written.totals.assign(count, emptyPixel());
    written.lights.assign(lit, noLight());
    written.totalLights.assign(lit, noLight());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t index = indexInArea(i);
        if (index == kOutside) {
            continue;
        }
        written.blocks[i] = block.pixels[index];
        if (lit > 0) {
            written.lights[i] = block.light[index];
        }
        if (!earlier.pixels.empty()) {
            written.totals[i] = earlier.pixels[index];
            if (lit > 0) {
                written.totalLights[i] = earlier.light[index];
            }
        }
    }
    deviceFilm.write(&DeviceFilm::Band::block, written.blocks);
    deviceFilm.write(&DeviceFilm::Band::total, written.totals);
    deviceFilm.write(&DeviceFilm::Band::blockLight, written.lights);
    deviceFilm.write(&DeviceFilm::Band::totalLight, written.totalLights);
    hasSums = true;
}

} // namespace metamarch::render
