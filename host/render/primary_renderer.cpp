// SPDX-License-Identifier: MIT
#include "metamarch/render/primary_renderer.h"

#include "metamarch/processor/processor_kernels.h"
#include "metamarch/render/cut_short.h"
#include "metamarch/render/processor_input.h"
#include "metamarch/render/tiling.h"
#include "metamarch/render/work_size.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace metamarch::render {
namespace {

// The most tiles of one submission: 2^13 tiles of 64 pixels have 56 MiB of output.
constexpr std::uint32_t kTilesPerSubmission = 1u << 13u;

// Returns true if every pixel has its sample.
bool copyTile(const std::span<const FilmPixel, kTilePixels> tile, const Tiling& tiling,
              const std::uint32_t place, std::vector<FilmPixel>& pixels) {
    bool isWhole = true;
    tiling.forEachPixelAt(place, [&](const std::uint32_t i, const std::size_t index) {
        pixels[index] = tile[i];
        isWhole = isWhole && tile[i].samples != 0;
    });
    return isWhole;
}

} // namespace

DeviceRender renderPrimaryOnDevice(const vulkan::Device& device, const SceneBuffers& scene,
                                   const std::string& traversal, const Camera& camera,
                                   const OnProgress& onProgress) {
    const Tiling tiling(camera);
    const std::uint32_t tiles = tiling.count;
    WorkSize work(std::min(tiles, kTilesPerSubmission));

    vulkan::ComputePipeline pipeline = scene.makePipeline(
        device, "primary", traversal,
        {.storageBindings = {kBindCamera, kBindOutput}, .pushConstantSize = sizeof(PrimaryPush)});
    const vulkan::Buffer input = vulkan::upload(device, std::span(&camera, 1), "camera");
    const std::uint64_t outputBytes =
        std::uint64_t{std::min(tiles, kTilesPerSubmission)} * kTilePixels * sizeof(FilmPixel);
    const vulkan::Buffer output(device, vulkan::BufferUse::storage, outputBytes, "pixels");
    const vulkan::Buffer readback(device, vulkan::BufferUse::readback, outputBytes, "pixels read back");
    pipeline.bind(kBindCamera, input);
    pipeline.bind(kBindOutput, output);
    vulkan::Submission submission(device);

    DeviceRender render;
    render.film = FilmData(std::size_t{camera.width} * camera.height, 0);
    bool isOn = true;
    for (std::uint32_t next = 0; isOn && next < tiles;) {
        const std::uint32_t count = std::min(work.units(), tiles - next);
        const std::uint64_t bytes = std::uint64_t{count} * kTilePixels * sizeof(FilmPixel);
        const double seconds = submission.run([&](vulkan::Commands& commands) {
            commands.dispatch(pipeline, {count, 1, 1}, PrimaryPush{next, tiling.order});
            commands.copy(output, 0, readback, 0, bytes);
        });
        const std::span tilePixels(reinterpret_cast<const FilmPixel*>(readback.mapped().data()),
                                   std::size_t{count} * kTilePixels);
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto tile = tilePixels.subspan(std::size_t{i} * kTilePixels).first<kTilePixels>();
            if (!copyTile(tile, tiling, next + i, render.film.pixels)) {
                refuseCutShort(kCutShort, device, traversal);
            }
        }
        work.finished(seconds);
        (render.submissions++ == 0 ? render.firstSeconds : render.deviceSeconds) += seconds;
        next += count;
        isOn = !onProgress || onProgress(static_cast<double>(next) / tiles);
    }
    return render;
}

std::vector<FilmPixel> renderPrimaryOnCpu(const AccelerationStructure& structure, const ShadingData& shading,
                                          const Camera& camera, const OnProgress& onProgress,
                                          const Kernel kernel) {
    KernelInput input = inputOver(structure);
    bindValues(input, kBindMaterialOfTriangle, std::span(shading.materialOfTriangle));
    bindValues(input, kBindMaterials, std::span(shading.materials));
    bindValues(input, kBindCamera, std::span(&camera, 1));
    input.invocations = kTilePixels;

    const Tiling tiling(camera);
    std::vector<FilmPixel> pixels(std::size_t{camera.width} * camera.height, emptyPixel());
    const auto drawTile = [&](const unsigned place) {
        std::array<FilmPixel, kTilePixels> tile;
        const PrimaryPush push{place, tiling.order};
        KernelInput ofTile = withPush(input, push);
        bindOutput(ofTile, kBindOutput, tile.data());
        kernel(ofTile);
        if (!copyTile(tile, tiling, place, pixels)) {
            throw std::logic_error("the kernel of the processor left pixels without their sample");
        }
    };
    forEachPiece(tiling.count, drawTile, onProgress);
    return pixels;
}

} // namespace metamarch::render
