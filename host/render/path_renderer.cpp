#include "render/path_renderer.h"

#include "render/cut_short.h"
#include "render/work_size.h"
#include "shared/primary.h"
#include "vulkan/submission.h"
#include "vulkan/transfer.h"

#include <algorithm>
#include <cstring>

namespace metamarch::render {
namespace {

// Tiles on the device at a time: their film is 112 MiB, within every device's maxStorageBufferRange.
constexpr std::uint32_t kMostTiles = 1u << 14u;

// Samples of a pixel in one dispatch: paths of unequal length even out over them, and the pixel's sums are
// read and written once.
constexpr std::uint32_t kSamplesAtOnce = 16;

struct Status {
    std::uint32_t unfinished;
    std::uint32_t stuck;
};

class Renderer {
  public:
    Renderer(const vulkan::Device& usedDevice, const SceneBuffers& scene, const ShadingBuffers& shading,
             const std::string& usedTraversal, const PathSettings& settings, const Camera& usedCamera)
        : device(usedDevice), traversal(usedTraversal), camera(usedCamera),
          tilesPerRow((camera.width + kTileSide - 1) / kTileSide),
          tileCount(tilesPerRow * ((camera.height + kTileSide - 1) / kTileSide)),
          pipeline(makePipeline(usedDevice, scene, shading, usedTraversal)),
          input(uploadInput(usedDevice, camera, settings)),
          film(usedDevice, vulkan::BufferUse::storage,
               std::uint64_t{bandTiles()} * kTilePixels * sizeof(FilmPixel), "film"),
          status(usedDevice, vulkan::BufferUse::storage, sizeof(Status), "status"),
          statusReadback(usedDevice, vulkan::BufferUse::readback, sizeof(Status), "status read back"),
          submission(usedDevice), work(bandTiles()) {
        shading.bindTo(pipeline);
        pipeline.bind(kBindInput, input);
        pipeline.bind(kBindOutput, film);
        pipeline.bind(kBindPathStatus, status);
    }

    PathRender run(const std::uint32_t samples, const std::function<void(double)>& onProgress) {
        PathRender render;
        render.film.resize(std::size_t{camera.width} * camera.height);
        for (std::uint32_t first = 0; first < tileCount; first += bandTiles()) {
            const std::uint32_t end = std::min(first + bandTiles(), tileCount);
            submission.run([&](vulkan::Commands& commands) { commands.fill(film, 0); });
            for (std::uint32_t taken = 0; taken < samples;) {
                const std::uint32_t endSample = taken + std::min(atOnce, samples - taken);
                for (std::uint32_t tile = first; tile < end;) {
                    const std::uint32_t count = std::min(work.units(), end - tile);
                    if (dispatch({tile, tilesPerRow, endSample, first}, count, render)) {
                        tile += count;
                    }
                    const double tiles = first + (end - first) * static_cast<double>(taken) / samples +
                                         (tile - first) * static_cast<double>(endSample - taken) / samples;
                    onProgress(tiles / tileCount);
                }
                taken = endSample;
            }
            unpack(first, end, render.film);
        }
        return render;
    }

  private:
    std::uint32_t bandTiles() const { return std::min(tileCount, kMostTiles); }

    static vulkan::Buffer uploadInput(const vulkan::Device& device, const Camera& camera,
                                      const PathSettings& settings) {
        const PathInput input{camera, settings};
        return vulkan::upload(device, std::span(&input, 1), "input");
    }

    static vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const SceneBuffers& scene,
                                                const ShadingBuffers& shading, const std::string& traversal) {
        vulkan::KernelInfo own{.storageBindings = {kBindOutput, kBindPathStatus},
                               .uniformBindings = {kBindInput},
                               .pushConstantSize = sizeof(PathPush)};
        shading.addTo(own);
        return scene.makePipeline(device, "path", traversal, own);
    }

    // Whether every pixel of the tiles has all its samples.
    bool dispatch(const PathPush& push, const std::uint32_t count, PathRender& render) {
        const double seconds = submission.run([&](vulkan::Commands& commands) {
            commands.fill(status, 0);
            commands.dispatch(pipeline, {count, 1, 1}, push);
            commands.copy(status, 0, statusReadback, 0, sizeof(Status));
        });
        work.finished(seconds);
        (render.submissions++ == 0 ? render.firstSeconds : render.deviceSeconds) += seconds;
        Status result{};
        std::memcpy(&result, statusReadback.mapped().data(), sizeof(Status));
        if (result.stuck > 0) {
            refuseCutShort(kCutShort, device, traversal);
        }
        if (result.unfinished > 0) {
            atOnce = std::max(atOnce / 2, 1u);
        }
        return result.unfinished == 0;
    }

    void unpack(const std::uint32_t first, const std::uint32_t end, std::vector<FilmPixel>& pixels) const {
        const auto tiles = vulkan::download<FilmPixel>(device, film);
        for (std::uint32_t i = 0; i < (end - first) * kTilePixels; ++i) {
            const std::uint32_t tile = first + i / kTilePixels;
            const std::uint32_t x = tile % tilesPerRow * kTileSide + i % kTileSide;
            const std::uint32_t y = tile / tilesPerRow * kTileSide + i % kTilePixels / kTileSide;
            if (x < camera.width && y < camera.height) {
                pixels[std::size_t{y} * camera.width + x] = tiles[i];
            }
        }
    }

    const vulkan::Device& device;
    std::string traversal;
    const Camera& camera;
    std::uint32_t tilesPerRow;
    std::uint32_t tileCount;
    std::uint32_t atOnce = kSamplesAtOnce;
    vulkan::ComputePipeline pipeline;
    vulkan::Buffer input;
    vulkan::Buffer film;
    vulkan::Buffer status;
    vulkan::Buffer statusReadback;
    vulkan::Submission submission;
    WorkSize work;
};

} // namespace

PathRender renderPaths(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
                       const std::string& traversal, const PathSettings& settings, const Camera& camera,
                       const std::uint32_t samples, const std::function<void(double)>& onProgress) {
    return Renderer(device, scene, shading, traversal, settings, camera).run(samples, onProgress);
}

} // namespace metamarch::render
