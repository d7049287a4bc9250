// SPDX-License-Identifier: MIT
// The path tracer on a Vulkan device, one short submission at a time: for pictures that are rendered at one
// go and for those that grow on a screen.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/film.h"
#include "metamarch/shared/path_input.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace metamarch::render {

// Tiles of kTilePixels in rows over the picture: [first, end).
struct TileRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    std::uint32_t count() const { return end - first; }
};

// How a picture is cut into tiles.
struct Tiling {
    explicit Tiling(const Camera& camera);

    std::uint32_t perRow;
    std::uint32_t count;
};

// Of the submissions since PathTracer was made, or since some other moment by a difference.
struct PathCounters {
    double deviceSeconds = 0.0; // without the first submission, which may compile
    double firstSeconds = 0.0;  // the first submission
    std::uint32_t submissions = 0;
    double samples = 0.0; // of one pixel each
    double rays = 0.0;    // shadow rays, too
    double steps = 0.0;   // of all rays
    double tests = 0.0;
};

class PathTracer {
  public:
    // Most samples of a pixel in one dispatch: paths of unequal length even out over them, and the pixel's
    // sums are read and written once.
    static constexpr std::uint32_t kSamplesAtOnce = 16;

    // `mostTiles`: the film's room on the device. `spirv` replaces the kernel that the program contains.
    // Throws Error(outOfMemory) where the film does not fit.
    PathTracer(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
               const std::string& traversal, std::uint32_t mostTiles,
               std::span<const std::uint32_t> spirv = {});

    // A new film of `tiles` of the camera's picture, at most mostTiles of them, without samples.
    void start(const Camera& camera, const PathSettings& settings, TileRange tiles);

    // One submission of about `targetSeconds`: some of the tiles get up to `samplesAtOnce` further samples,
    // those at the picture's top first. Not beyond `endSample`, and none has more than samplesAtOnce more
    // than another. Returns the tiles that have changed. Throws Error(outOfMemory) where the driver cuts a
    // traversal short.
    TileRange advance(std::uint32_t endSample, std::uint32_t samplesAtOnce, double targetSeconds);

    // Those that have samples.
    TileRange begunTiles() const;

    // Samples that every pixel has, and the mean over the tiles.
    std::uint32_t samples() const { return taken; }
    double meanSamples() const;

    const PathCounters& counters() const { return sums; }

    // [tile - tiles.first][pixel in tile], of begunTiles().
    const vulkan::Buffer& film() const { return filmBuffer; }
    const Camera& camera() const { return input.camera; }

    // Copies the film into a picture of camera.width * camera.height in rows from the top. Pixels without
    // samples stay as they are.
    void download(std::vector<FilmPixel>& pixels) const;

  private:
    bool dispatch(TileRange part, std::uint32_t endSample);

    const vulkan::Device& device;
    std::string traversal;
    vulkan::ComputePipeline pipeline;
    vulkan::Buffer inputBuffer;
    vulkan::Buffer filmBuffer;
    vulkan::Buffer status;
    vulkan::Buffer statusReadback;
    vulkan::Submission submission;
    WorkSize work; // in samples of a tile
    PathInput input{};
    TileRange tiles;
    std::uint32_t tilesPerRow = 0;
    std::uint32_t taken = 0;
    std::uint32_t passEnd = 0;              // samples that the pass under way leads to
    std::uint32_t next = 0;                 // its next tile
    std::uint32_t fitting = kSamplesAtOnce; // samples that the driver brings to their end at once
    TileRange unfinished;                   // the last part, where the driver left something of it undone
    PathCounters sums;
};

} // namespace metamarch::render
