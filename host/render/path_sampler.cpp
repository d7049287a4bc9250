// SPDX-License-Identifier: MIT
#include "metamarch/render/path_sampler.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/path.h"

#include <algorithm>
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
bool takeBlock(PathSums& sums, const std::vector<std::uint8_t>& active, const std::uint32_t endSample,
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

CpuPathSampler::CpuPathSampler(const AccelerationStructure& structure, const ShadingScene& scene,
                               const PathWork& work)
    : structure_(structure), scene_(scene), work_(work), sums_(noSums(work, 0)) {}

bool CpuPathSampler::take(const std::uint32_t endSample, const OnProgress& onProgress) {
    return takeBlock(sums_, active_, endSample, [&](FilmData& block) {
        return takeBlockOnCpu(structure_, scene_, work_.settings, work_.camera, work_.area, sums_.blockFirst,
                              endSample - sums_.blockFirst, work_.request, block, onProgress);
    });
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
    return takeBlock(sums_, active_, endSample, [&](FilmData& block) {
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
