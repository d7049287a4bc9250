// SPDX-License-Identifier: MIT
#include "metamarch/render/display_filter.h"

#include "metamarch/render/kernel.h"
#include "metamarch/shared/tile_order.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace metamarch::render {
namespace {

constexpr std::uint32_t kRowKernelPush = sizeof(FilterPush);
constexpr float kFirstTolerance = 4.0f; // FilterPush::tolerance of single samples

struct Bound {
    std::uint32_t binding;
    const vulkan::Buffer& buffer;
};

vulkan::ComputePipeline boundKernel(const vulkan::Device& device, const char* const name,
                                    const std::uint32_t pushSize, const std::initializer_list<Bound> all) {
    vulkan::KernelInfo own{.pushConstantSize = pushSize};
    for (const Bound& bound : all) {
        own.storageBindings.push_back(bound.binding);
    }
    vulkan::ComputePipeline pipeline = makeKernel(device, name, own);
    for (const Bound& bound : all) {
        pipeline.bind(bound.binding, bound.buffer);
    }
    return pipeline;
}

vulkan::Buffer pixelBuffer(const vulkan::Device& device, const std::uint32_t pixels, const char* const name) {
    return {device, vulkan::BufferUse::storage, std::uint64_t{pixels} * sizeof(FilterLight), name};
}

// From 1 for a single sample down to 0 for kEnough.
float strengthAt(const std::uint32_t samples) {
    return static_cast<float>(1.0 - std::log2(static_cast<double>(samples)) /
                                        std::log2(static_cast<double>(DisplayFilter::kEnough)));
}

} // namespace

bool DisplayFilter::fits(const vulkan::Device& device, const std::uint64_t pixels) {
    return pixels * sizeof(FilterLight) <= device.report().maxStorageBufferRange;
}

DisplayFilter::DisplayFilter(const vulkan::Device& usedDevice, const PathTracer& tracer,
                             const vulkan::Buffer& picture, const std::uint32_t mostPixels)
    : device(usedDevice), film(tracer.film()), surfaces(pixelBuffer(usedDevice, mostPixels, "surfaces")),
      shapes(pixelBuffer(usedDevice, mostPixels, "shapes")),
      before(pixelBuffer(usedDevice, mostPixels, "light before the filter")),
      even(pixelBuffer(usedDevice, mostPixels, "filtered light")),
      odd(pixelBuffer(usedDevice, mostPixels, "filtered light in turn")),
      result(pixelBuffer(usedDevice, mostPixels, "filtered picture")),
      showing(boundKernel(usedDevice, "filter_show", kRowKernelPush,
                          {{kBindFilterFrom, result}, {kBindOutput, picture}})),
      submission(usedDevice), work(kMostGroups) {
    for (const DeviceFilm::Band& band : film.bands()) {
        beginning.push_back(boundKernel(device, "filter_begin", sizeof(FilterBeginPush),
                                        {{kBindInput, band.block},
                                         {kBindTotal, band.total},
                                         {kBindFilterSurface, surfaces},
                                         {kBindFilterShape, shapes},
                                         {kBindFilterTo, before}}));
    }
    stages.push_back({boundKernel(device, "filter_variance", kRowKernelPush,
                                  {{kBindFilterSurface, surfaces},
                                   {kBindFilterShape, shapes},
                                   {kBindFilterFrom, before},
                                   {kBindFilterTo, even}}),
                      0});
    for (std::uint32_t pass = 0; pass < kFilterPasses; ++pass) {
        stages.push_back({boundKernel(device, "filter_pass", kRowKernelPush,
                                      {{kBindFilterSurface, surfaces},
                                       {kBindFilterShape, shapes},
                                       {kBindFilterFrom, pass % 2 == 0 ? even : odd},
                                       {kBindFilterTo, pass % 2 == 0 ? odd : even}}),
                          1u << pass});
    }
    stages.push_back({boundKernel(device, "filter_end", kRowKernelPush,
                                  {{kBindFilterSurface, surfaces},
                                   {kBindFilterFrom, before},
                                   {kBindFilterTo, kFilterPasses % 2 == 0 ? even : odd},
                                   {kBindOutput, result}}),
                      0});
    stage = stages.size();
}

void DisplayFilter::start(const glm::uvec2 wantedSize, const std::uint32_t wantedSamples) {
    size = wantedSize;
    samples = wantedSamples;
    stage = 0;
    row = 0;
    const Tiling tiling(PixelRect{0, 0, size.x, size.y});
    submission.run([&](vulkan::Commands& commands) {
        for (std::uint32_t first = 0; first < tiling.count;) {
            const std::uint32_t band = first / film.tilesOfBand();
            const std::uint32_t bandPlace = band * film.tilesOfBand();
            const std::uint32_t end =
                std::min({tiling.count, first + kMostGroups, bandPlace + film.tilesOfBand()});
            commands.dispatch(beginning[band], {end - first, 1, 1},
                              FilterBeginPush{first, tiling.order, bandPlace, size.x, size.y});
            first = end;
        }
    });
}

FilterPush DisplayFilter::push() const {
    const float strength = strengthAt(samples);
    return {.firstRow = row,
            .width = size.x,
            .height = size.y,
            .isSingle = samples == 1 ? 1u : 0u,
            .distance = 0,
            .tolerance = kFirstTolerance * strength,
            .kept = 1.0f - (1.0f - strength) * (1.0f - strength),
            .toneOperator = 0,
            .scale = 1.0f};
}

bool DisplayFilter::advance(const double seconds) {
    const std::uint32_t rows = std::min(work.units(), size.y - row);
    FilterPush own = push();
    own.distance = stages[stage].distance;
    const double spent = submission.run([&](vulkan::Commands& commands) {
        commands.dispatch(stages[stage].pipeline, {(size.x + kFilterRow - 1) / kFilterRow, rows, 1}, own);
    });
    work.finished(spent * work.units() / rows, seconds);
    row += rows;
    if (row == size.y) {
        row = 0;
        ++stage;
    }
    return !isWorking();
}

void DisplayFilter::show(vulkan::Commands& commands, const ToneMapping& tone) const {
    FilterPush own = push();
    own.toneOperator = tone.toneOperator;
    own.scale = exposureScale(tone);
    for (own.firstRow = 0; own.firstRow < size.y; own.firstRow += kMostGroups) {
        const std::uint32_t rows = std::min(size.y - own.firstRow, kMostGroups);
        commands.dispatch(showing, {(size.x + kFilterRow - 1) / kFilterRow, rows, 1}, own);
    }
}

} // namespace metamarch::render
