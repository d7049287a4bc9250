// SPDX-License-Identifier: MIT
// Runs the path tracer on a Vulkan device, one short submission at a time. Both whole pictures and pictures
// that grow on a screen are made with it.
#pragma once
#include "metamarch/render/device_film.h"
#include "metamarch/render/film_run.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/render/tiling.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/path_input.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace metamarch::render {

// Sums over all submissions of a PathTracer. The difference of two values covers the time between them.
struct PathCounters {
    double deviceSeconds = 0.0; // of all submissions but the first
    double firstSeconds = 0.0;  // of the first submission, in which the driver may compile the kernel
    std::uint32_t submissions = 0;
    double samples = 0.0; // over all pixels
    double rays = 0.0;    // with shadow rays
    double steps = 0.0;   // of all rays
    double tests = 0.0;
};

class PathTracer {
  public:
    // The most surfaces of an invocation in one dispatch: enough for 16 samples of 64 surfaces.
    static constexpr std::uint32_t kFirstTurns = 1024;

    // Compiles the kernel for cameras with the features of `firstCamera`, and allocates a film of `mostTiles`
    // tiles on the device, with the parts kFilm… that `parts` names. A `spirv` that is not empty replaces the
    // embedded kernel. All that is referred to must outlive the tracer. Throws Error(outOfMemory) if the film
    // does not fit, and what SceneBuffers::makePipeline throws.
    PathTracer(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
               const std::string& traversal, const Camera& firstCamera, std::uint32_t mostTiles,
               std::uint32_t parts = 0, std::span<const std::uint32_t> spirv = {},
               std::uint32_t firstTurns = kFirstTurns, std::uint32_t mostTilesOfBand = DeviceFilm::kAllTiles);

    // Begins a film without samples. It covers `tiles` of the camera's picture, at most mostTiles of them. A
    // camera with other features than the one before needs another kernel.
    void start(const Camera& camera, const PathSettings& settings, TileRange tiles);

    // The same for the tiles of an area of the picture, and for samples from number firstSample on: the first
    // sample of a block, or one that is alone.
    void start(const Camera& camera, const PathSettings& settings, const PixelRect& area, TileRange tiles,
               std::uint32_t firstSample);

    // After start(): gives the film sums that were taken earlier. `block` has the samples of each pixel from
    // firstSample on, at most a block of them, and `earlier` those before. The films cover the area; an
    // `earlier` that is empty stands for no samples.
    void upload(const FilmData& earlier, const FilmData& block);

    // Takes further samples in one submission of about `targetSeconds`. Passes run over the film in the order
    // of its tiles, and each adds up to `samplesAtOnce` samples to every pixel, but none beyond `endSample`
    // and none beyond the end of a block (film.h); one call is a part of a pass. Returns the tiles that have
    // changed. Throws Error(outOfMemory) if the driver cuts a traversal short.
    TileRange advance(std::uint32_t endSample, std::uint32_t samplesAtOnce, double targetSeconds);

    // Returns the tiles that have samples.
    TileRange begunTiles() const;

    // samples() is the number of the sample that is next for every pixel, meanSamples() the mean over the
    // tiles.
    std::uint32_t samples() const { return taken; }
    double meanSamples() const;

    const PathCounters& counters() const { return sums; }

    // addPixel makes a pixel of its two sums. The tile in place p is tile p - tiles.first of the film. Only
    // begunTiles() are valid.
    const DeviceFilm& film() const { return deviceFilm; }
    const Camera& camera() const { return input.camera; }

    // Copies the film into `film`, which covers the area. Pixels without samples stay as they are.
    void download(FilmData& film) const;

    // Returns a pixel of the film, by its place in the area; one without samples where the film has not
    // begun. It reads no more than that from the device.
    FilmPixel pixel(std::uint32_t x, std::uint32_t y) const;

    // The same in the form that upload() takes, and the number of the block's first sample. An `earlier` that
    // is empty stays so. With kFilmHits, `block` says what was uploaded: first hits of further samples are
    // counted, with `groups` of each triangle; those of earlier blocks are not on the device.
    std::uint32_t downloadSums(FilmData& earlier, FilmData& block,
                               std::span<const std::uint32_t> groups = {}) const;

  private:
    struct TileSums;

    // Where a pixel gains no sample, the next dispatch has so many times as many turns, up to kMostTurns.
    static constexpr std::uint32_t kMoreTurns = 16;
    static constexpr std::uint32_t kMostTurns = 0xffffffffu;

    enum class Outcome {
        whole,       // every pixel of the tiles has its samples
        outOfTurns,  // some pixels lack samples, because PathPush::turns has ended their invocations
        cutByDriver, // some of them, because the driver has ended them
        stuck,       // some of the former gained none
    };
    Outcome dispatch(TileRange part, std::uint32_t firstSample, std::uint32_t endSample);
    void preparePipeline(std::uint32_t wantedFeatures);
    void bindBand(std::size_t band);
    TileSums readSums() const;
    std::size_t indexInArea(std::uint32_t i) const;
    std::uint32_t placeOfTile(std::uint32_t row, std::uint32_t column) const;

    const vulkan::Device& device;
    const SceneBuffers& scene;
    const ShadingBuffers& shading;
    std::string traversal;
    std::uint32_t parts;
    std::span<const std::uint32_t> spirv;
    std::optional<vulkan::ComputePipeline> pipeline;
    std::uint32_t pipelineFeatures = 0; // of the cameras that it is for
    vulkan::ComputePipeline addBlock;
    vulkan::Buffer inputBuffer;
    DeviceFilm deviceFilm;
    std::size_t boundBand = 0;
    vulkan::Buffer status;
    vulkan::Buffer statusReadback;
    vulkan::Submission submission;
    WorkSize work; // unit: one sample of every pixel of a tile
    PathInput input{};
    PixelRect area;
    TileRange tiles;
    TileOrder order{};
    std::uint32_t filmFirst = 0;           // number of the film's first sample
    std::uint32_t blockFirst = 0;          // number of the current block's first sample
    bool hasSums = false;                  // upload() has given the current block samples
    std::uint32_t taken = 0;               // the number of the next sample of every pixel
    std::uint32_t passEnd = 0;             // the number of samples that the current pass ends with
    std::uint32_t next = 0;                // the next place of the current pass
    std::uint32_t fitting = kBlockSamples; // the driver can probably finish this number per dispatch
    TileRange unfinished;                  // the last part, if it has not all samples of the pass yet
    std::uint32_t unfinishedTaken = 0;     // the number of samples that it has at least
    std::uint32_t turns;                   // PathPush::turns
    PathCounters sums;
};

} // namespace metamarch::render
