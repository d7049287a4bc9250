// SPDX-License-Identifier: MIT
// Takes samples with the path tracer and keeps their sums, on a device or on the CPU.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/processor/processor_kernels.h"
#include "metamarch/reference/pieces.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/render/shading_arrays.h"
#include "metamarch/render/tiling.h"
#include "metamarch/shared/film_data.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace metamarch::render {

// Returns how many tiles the device's film has: all of them, or as many as `mostTiles` and the free memory
// allow. Half of that is left to the driver and to other programs.
std::uint32_t tilesAtOnce(std::uint32_t tiles, std::uint32_t mostTiles, std::uint64_t freeBytes,
                          std::uint64_t bytesOfTile);

// The sums of an area's pixels in the middle of a block.
struct PathSums {
    FilmData earlier;             // of all blocks before the current one
    std::uint32_t blockFirst = 0; // number of the current block's first sample
    FilmData block;
};

// What all samples of a picture share.
struct PathWork {
    PathSettings settings;
    Camera camera;
    PixelRect area; // of the camera's picture
    FilmRequest request{};
};

class PathSampler {
  public:
    PathSampler() = default;
    virtual ~PathSampler() = default;
    PathSampler(const PathSampler&) = delete;
    PathSampler& operator=(const PathSampler&) = delete;

    // Goes on with these sums. The block begins at a block of the samples of a pixel (kBlockSamples), or is a
    // single sample.
    virtual void start(PathSums sums) = 0;

    // Takes samples until each pixel has those before number `endSample`, which is not beyond the end of the
    // next block. Calls `onProgress` after each submission, or each tile on the CPU. If that cancels, returns
    // false; another call takes the missing samples.
    virtual bool take(std::uint32_t endSample, const OnProgress& onProgress) = 0;

    // From now on only the pixels with 1 take samples: a flag for each pixel of the area.
    virtual void setActive(std::vector<std::uint8_t> active) = 0;

    // Copies the sums, also after a call of take() that was cancelled.
    virtual PathSums sums() const = 0;
};

// Takes the samples before number `endSample` that are missing, and returns all sums.
FilmData takeSamples(PathSampler& sampler, std::uint32_t endSample);

// Without samples.
PathSums noSums(const PathWork& work, std::uint32_t firstSample);

// Keeps the sums in the host's memory. Uses all cores; tiles that are cancelled stay as they are.
class HostPathSampler : public PathSampler {
  public:
    void start(PathSums sums) override { sums_ = std::move(sums); }
    void setActive(std::vector<std::uint8_t> active) override { active_ = std::move(active); }
    bool take(std::uint32_t endSample, const OnProgress& onProgress) override;
    PathSums sums() const override { return sums_; }

  protected:
    explicit HostPathSampler(const PathWork& work) : work_(work), sums_(noSums(work, 0)) {}

    // Takes samples of each pixel until it has `samples` of the block, which begins with sample number
    // `first`.
    virtual bool takeBlock(std::uint32_t first, std::uint32_t samples, FilmData& block,
                           const OnProgress& onProgress) = 0;

    const PathWork& work() const { return work_; }

  private:
    PathWork work_;
    PathSums sums_;
    std::vector<std::uint8_t> active_; // none: all pixels are
};

// Executes the kernel of the device on the processor: shaders/processor.
class CpuPathSampler : public HostPathSampler {
  public:
    // Structure and scene must outlive the sampler. `kernel` is one of pathKernels(), the fastest if it is
    // null. Throws Error(outOfMemory) if an array of the scene has more than 4 GiB.
    CpuPathSampler(const AccelerationStructure& structure, const ShadingScene& scene, const PathWork& work,
                   Kernel kernel = nullptr);

  private:
    bool takeBlock(std::uint32_t first, std::uint32_t samples, FilmData& block,
                   const OnProgress& onProgress) override;
    void takeTile(std::uint32_t place, std::uint32_t first, std::uint32_t samples, FilmData& block) const;

    ShadingArrays arrays_;
    PathInput input_;
    Tiling tiling_;
    KernelInput shared_; // what all tiles have in common
    Kernel kernel_;
};

// Takes the samples of src/reference, over the stack traversal: to step through, and to judge the others.
class JudgePathSampler : public HostPathSampler {
  public:
    // Structure and scene must outlive the sampler.
    JudgePathSampler(const AccelerationStructure& structure, const ShadingScene& scene, const PathWork& work)
        : HostPathSampler(work), structure_(structure), scene_(scene) {}

  private:
    bool takeBlock(std::uint32_t first, std::uint32_t samples, FilmData& block,
                   const OnProgress& onProgress) override;

    const AccelerationStructure& structure_;
    const ShadingScene& scene_;
};

// The film stays on the device. One of more than `mostTiles` tiles, one that is too large for the device's
// memory, or one of which not all pixels take samples, is in the host's memory, and each pass takes it to the
// device in bands.
class DevicePathSampler : public PathSampler {
  public:
    // The film has bands of fewer tiles than `mostTiles` where the device's memory is short. Throws what the
    // constructor of PathTracer throws.
    DevicePathSampler(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
                      const std::string& traversal, const PathWork& work,
                      std::uint32_t mostTiles = kMostTiles);

    void start(PathSums sums) override;
    void setActive(std::vector<std::uint8_t> active) override;
    // Also throws what PathTracer::advance throws.
    bool take(std::uint32_t endSample, const OnProgress& onProgress) override;
    PathSums sums() const override;

    const PathCounters& counters() const { return tracer_->counters(); }

    // Each of the buffers of their film is 112 MiB, within every device's maxStorageBufferRange.
    static constexpr std::uint32_t kMostTiles = 1u << 14u;

  private:
    bool isOnHost() const {
        return tiles_ > mostTiles_ || !active_.empty() || (work_.request.parts & kFilmHits) != 0;
    }
    bool advanceTo(std::uint32_t endSample, TileRange tiles, const OnProgress& onProgress);
    bool takeBand(std::uint32_t endSample, TileRange tiles, FilmData& block, bool isBegun,
                  const OnProgress& onProgress);

    PathWork work_;
    std::uint32_t tiles_;
    std::uint32_t mostTiles_;
    std::unique_ptr<PathTracer> tracer_;
    PathSums sums_;                    // if the film is in the host's memory
    std::vector<std::uint8_t> active_; // none: all pixels are
};

} // namespace metamarch::render
