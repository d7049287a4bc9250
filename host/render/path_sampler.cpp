// SPDX-License-Identifier: MIT
#include "metamarch/render/path_sampler.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/path.h"
#include "metamarch/render/processor_input.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace metamarch::render {
namespace {

// A film of 128 x 128 pixels: less memory is not worth a band.
constexpr std::uint32_t kLeastTiles = 256;

// Begins the next block if all pixels have the whole of the current one, and samples behind it are wanted.
void beginBlock(PathSums& sums, const std::uint32_t endSample) {
    if (endSample > sums.blockFirst + kBlockSamples) {
        addBlock(sums.earlier, sums.block);
        sums.block = FilmData(sums.earlier.pixels.size(), sums.earlier.parts());
        sums.blockFirst += kBlockSamples;
    }
}

bool hasSamples(const FilmData& film) {
    return std::ranges::any_of(film.pixels, [](const FilmPixel& pixel) { return pixel.samples > 0; });
}

// Calls `take` with the current block, or the next if the sums have the whole of it. Pixels that are not
// active pretend to have a whole block meanwhile, so that nothing is taken for them. Without flags all are
// active.
template <class Take>
bool takeActive(PathSums& sums, const std::vector<std::uint8_t>& active, const std::uint32_t endSample,
                const Take& take) {
    beginBlock(sums, endSample);
    if (active.empty()) {
        return take(sums.block);
    }
    FilmData block = sums.block;
    for (std::size_t i = 0; i < active.size(); ++i) {
        if (active[i] == 0) {
            block.pixels[i].samples = kBlockSamples;
        }
    }
    const bool isWhole = take(block);
    for (std::size_t i = 0; i < active.size(); ++i) {
        if (active[i] == 0) {
            block.pixels[i] = sums.block.pixels[i];
            if (!block.light.empty()) {
                block.light[i] = sums.block.light[i];
            }
        }
    }
    sums.block = std::move(block);
    return isWhole;
}

} // namespace

PathSums noSums(const PathWork& work, const std::uint32_t firstSample) {
    const FilmData film(work.area.pixelCount(), work.request.parts);
    return {film, firstSample, film};
}

FilmData takeSamples(PathSampler& sampler, const std::uint32_t endSample) {
    for (std::uint32_t next = 0; next < endSample;) {
        next = std::min(next + kBlockSamples, endSample);
        sampler.take(next, {});
    }
    PathSums sums = sampler.sums();
    addBlock(sums.earlier, sums.block);
    return std::move(sums.earlier);
}

bool HostPathSampler::take(const std::uint32_t endSample, const OnProgress& onProgress) {
    return takeActive(sums_, active_, endSample, [&](FilmData& block) {
        return takeBlock(sums_.blockFirst, endSample - sums_.blockFirst, block, onProgress);
    });
}

bool JudgePathSampler::takeBlock(const std::uint32_t first, const std::uint32_t samples, FilmData& block,
                                 const OnProgress& onProgress) {
    return takeBlockByJudge(structure_, scene_, work().settings, work().camera, work().area, first, samples,
                            work().request, block, onProgress);
}

CpuPathSampler::CpuPathSampler(const AccelerationStructure& structure, const ShadingScene& scene,
                               const PathWork& work, const Kernel kernel)
    : HostPathSampler(work), arrays_(scene), input_{work.camera,   work.settings,     work.area.left,
                                                    work.area.top, work.area.width(), work.area.height()},
      tiling_(work.area), shared_(inputOver(structure)) {
    for (const ShadingArray& array : arrays_.arrays()) {
        bindBytes(shared_, array.binding, array.data);
    }
    bindValues(shared_, kBindInput, std::span(&std::as_const(input_), 1));
    const std::uint32_t features = scene.features | cameraFeatures(work.camera);
    shared_.constants[kSpecFeatures] = features;
    shared_.constants[kSpecFilm] = work.request.parts;
    shared_.invocations = kTilePixels;
    kernel_ = kernel != nullptr ? kernel : pathKernels(features).front().run;
}

// The film that the kernel sees is that of the tile alone.
void CpuPathSampler::takeTile(const std::uint32_t place, const std::uint32_t first,
                              const std::uint32_t samples, FilmData& block) const {
    std::array<FilmPixel, kTilePixels> pixels;
    std::array<FilmPixel, kTilePixels> totals; // written with other push constants alone
    std::array<LightParts, kTilePixels> light;
    std::array<std::array<std::uint32_t, kBlockSamples>, kTilePixels> hits;
    PathStatus status{};
    tiling_.forEachPixelAt(place, [&](const std::uint32_t i, const std::size_t index) {
        pixels[i] = block.pixels[index];
        if (!block.light.empty()) {
            light[i] = block.light[index];
        }
    });

    const PathPush push{.firstPlace = place,
                        .order = tiling_.order,
                        .firstSample = first,
                        .samples = samples,
                        .bandPlace = place,
                        .isFresh = 0,
                        .turns = std::numeric_limits<std::uint32_t>::max()};
    KernelInput input = withPush(shared_, push);
    bindOutput(input, kBindOutput, pixels.data());
    bindOutput(input, kBindTotal, totals.data());
    bindOutput(input, kBindLight, light.data());
    bindOutput(input, kBindHits, hits.data());
    bindOutput(input, kBindPathStatus, &status);
    kernel_(input);
    if (status.unfinished != 0) {
        throw std::logic_error("the kernel of the processor left pixels without their samples");
    }

    tiling_.forEachPixelAt(place, [&](const std::uint32_t i, const std::size_t index) {
        if (!block.hits.empty()) {
            for (std::uint32_t sample = block.pixels[index].samples; sample < pixels[i].samples; ++sample) {
                if (hits[i][sample] != kNoTriangle) {
                    block.addHit(index, work().request.groups[hits[i][sample]]);
                }
            }
        }
        block.pixels[index] = pixels[i];
        if (!block.light.empty()) {
            block.light[index] = light[i];
        }
    });
}

bool CpuPathSampler::takeBlock(const std::uint32_t first, const std::uint32_t samples, FilmData& block,
                               const OnProgress& onProgress) {
    std::vector<std::uint32_t> missing; // places of tiles
    for (std::uint32_t place = 0; place < tiling_.count; ++place) {
        bool isWhole = true;
        tiling_.forEachPixelAt(place, [&](std::uint32_t, const std::size_t index) {
            isWhole = isWhole && block.pixels[index].samples >= samples;
        });
        if (!isWhole) {
            missing.push_back(place);
        }
    }
    const auto count = static_cast<double>(missing.size());
    const auto onPart = [&](const double part) {
        return !onProgress || onProgress(1.0 - (1.0 - part) * count / tiling_.count);
    };
    return forEachPiece(
        static_cast<unsigned>(missing.size()),
        [&](const unsigned i) { takeTile(missing[i], first, samples, block); }, onPart);
}

std::uint32_t tilesAtOnce(const std::uint32_t tiles, const std::uint32_t mostTiles,
                          const std::uint64_t freeBytes, const std::uint64_t bytesOfTile) {
    const std::uint64_t fitting = std::max<std::uint64_t>(freeBytes / 2 / bytesOfTile, kLeastTiles);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({tiles, mostTiles, fitting}));
}

DevicePathSampler::DevicePathSampler(const vulkan::Device& device, const SceneBuffers& scene,
                                     const ShadingBuffers& shading, const std::string& traversal,
                                     const PathWork& work, const std::uint32_t mostTiles)
    : work_(work), tiles_(Tiling(work.area).count),
      mostTiles_(
          tilesAtOnce(tiles_, mostTiles, device.freeMemory(), DeviceFilm::bytesOfTile(work.request.parts))) {
    while (!tracer_) {
        try {
            tracer_ = std::make_unique<PathTracer>(device, scene, shading, traversal, work.camera, mostTiles_,
                                                   work.request.parts);
        } catch (const Error& error) {
            // What is free is an estimate: other programs take memory too.
            if (error.kind != ErrorKind::outOfMemory || mostTiles_ <= kLeastTiles) {
                throw;
            }
            mostTiles_ = std::max(mostTiles_ / 2, kLeastTiles);
        }
    }
    start(noSums(work, 0));
}

void DevicePathSampler::start(PathSums sums) {
    if (isOnHost()) {
        sums_ = std::move(sums);
        return;
    }
    tracer_->start(work_.camera, work_.settings, work_.area, {0, tiles_}, sums.blockFirst);
    if (hasSamples(sums.earlier) || hasSamples(sums.block)) {
        tracer_->upload(sums.earlier, sums.block);
    }
}

void DevicePathSampler::setActive(std::vector<std::uint8_t> active) {
    if (!isOnHost()) {
        sums_ = sums();
    }
    active_ = std::move(active);
}

bool DevicePathSampler::advanceTo(const std::uint32_t endSample, const TileRange tiles,
                                  const OnProgress& onProgress) {
    const double first = tracer_->meanSamples();
    while (tracer_->samples() < endSample) {
        tracer_->advance(endSample, kBlockSamples, WorkSize::kTargetSeconds);
        const double ofBand = (tracer_->meanSamples() - first) / (endSample - first);
        if (onProgress && !onProgress((tiles.first + ofBand * tiles.count()) / tiles_)) {
            return tracer_->samples() == endSample && tiles.end == tiles_;
        }
    }
    return true;
}

bool DevicePathSampler::takeBand(const std::uint32_t endSample, const TileRange tiles, FilmData& block,
                                 const bool isBegun, const OnProgress& onProgress) {
    tracer_->start(work_.camera, work_.settings, work_.area, tiles, sums_.blockFirst);
    if (isBegun) {
        tracer_->upload({}, block);
    }
    const bool isWhole = advanceTo(endSample, tiles, onProgress);
    FilmData none;
    tracer_->downloadSums(none, block, work_.request.groups);
    return isWhole;
}

bool DevicePathSampler::take(const std::uint32_t endSample, const OnProgress& onProgress) {
    if (!isOnHost()) {
        return advanceTo(endSample, {0, tiles_}, onProgress);
    }
    return takeActive(sums_, active_, endSample, [&](FilmData& block) {
        const bool isBegun = hasSamples(block);
        bool isOn = true;
        for (std::uint32_t first = 0; isOn && first < tiles_; first += mostTiles_) {
            isOn = takeBand(endSample, {first, std::min(first + mostTiles_, tiles_)}, block, isBegun,
                            onProgress);
        }
        return isOn;
    });
}

PathSums DevicePathSampler::sums() const {
    if (isOnHost()) {
        return sums_;
    }
    PathSums sums = noSums(work_, 0);
    sums.blockFirst = tracer_->downloadSums(sums.earlier, sums.block);
    return sums;
}

} // namespace metamarch::render
