// SPDX-License-Identifier: MIT
// Pictures that make the algorithm visible: the kernels `inspect` and `cells`.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/render/view_names.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/inspect_view.h"
#include "metamarch/vulkan/submission.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace metamarch::render {

// One picture at a time, in submissions as short as the caller wants them. What it is made of must outlive
// it.
class Inspector {
  public:
    // `mostPixels`: room for pictures of that many. `spirv` and `cellsSpirv`, where there is some, take the
    // place of the embedded shaders: kernel `inspect` with `traversal` and kernel `cells`, both built for
    // scene.memoryKind().
    Inspector(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
              const std::string& traversal, std::uint32_t mostPixels,
              std::span<const std::uint32_t> spirv = {}, std::span<const std::uint32_t> cellsSpirv = {});

    // A new picture: `view` is one of kView…, `scaleMax` as they say, positive. Makes the view's pipeline,
    // which it may share with others, at first need; submits no more than the camera. Until the picture is
    // whole, the pixels still to come are those of the picture before. Throws std::invalid_argument for a
    // picture without pixels or with more than mostPixels, a number that is no view, or a scale that is not
    // positive.
    void start(const Camera& camera, std::uint32_t view, float scaleMax);

    // One submission of about `targetSeconds` at most; true once the picture is whole, and nothing is
    // submitted then. A trace that the driver ends early is drawn in kUnfinishedColor.
    bool advance(double targetSeconds = WorkSize::kTargetSeconds);

    bool isWhole() const { return nextTile == tileCount; }

    // What this picture took so far, without a pipeline's first submission, which may compile.
    double deviceSeconds() const { return seconds; }

    // Pixels as packedPixel makes them, in rows: y * width + x. Larger where the picture is smaller than
    // mostPixels.
    const vulkan::Buffer& picture() const { return pixels; }

    std::vector<std::uint32_t> download() const; // the picture, and no more

  private:
    struct Program {
        vulkan::ComputePipeline pipeline;
        WorkSize work;
    };

    vulkan::ComputePipeline makePipeline(ViewReads reads) const;

    const vulkan::Device& device;
    const SceneBuffers& scene;
    const ShadingBuffers& shading;
    std::string traversal;
    std::uint32_t mostPixels;
    vulkan::Buffer camera;
    vulkan::Buffer pixels;
    vulkan::Submission submission;
    std::vector<std::uint32_t> spirv; // in place of the embedded shaders; empty: none
    std::vector<std::uint32_t> cellsSpirv;
    std::map<ViewReads, Program> programs; // made so far

    // Of the picture.
    Program* program = nullptr;
    std::uint32_t pixelCount = 0;
    std::uint32_t tilesPerRow = 0;
    std::uint32_t tileCount = 0;
    std::uint32_t nextTile = 0;
    std::uint32_t view = 0;
    float scaleMax = 1.0f;
    double seconds = 0.0;
};

} // namespace metamarch::render
