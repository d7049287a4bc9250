// SPDX-License-Identifier: MIT
// Draws views, which make the algorithm visible, with the kernels `inspect` and `cells`.
#pragma once
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/render/tiling.h"
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

// Draws one picture at a time, in submissions as short as the caller wants. Device, scene and shading must
// outlive it.
class Inspector {
  public:
    // Allocates room for pictures of up to `mostPixels` pixels. A `spirv` that is not empty replaces the
    // embedded kernel `inspect` with `traversal`, and `cellsSpirv` the kernel `cells`; both must be built for
    // scene.memoryKind().
    Inspector(const vulkan::Device& device, const SceneBuffers& scene, const ShadingBuffers& shading,
              const std::string& traversal, std::uint32_t mostPixels,
              std::span<const std::uint32_t> spirv = {}, std::span<const std::uint32_t> cellsSpirv = {});

    // Begins a new picture. `view` is one of kView…; `scaleMax` and `scaleMin` are those of InspectPush. The
    // first call for a view creates its pipeline, which other views may share. It uploads the camera and
    // draws nothing: until advance() reaches a pixel, it keeps its old colour. Throws std::invalid_argument
    // if the picture has no pixels or more than mostPixels, if `view` is not a view, or if `scaleMax` is not
    // greater than `scaleMin`.
    void start(const Camera& camera, std::uint32_t view, float scaleMax, float scaleMin = 0.0f);

    // Draws a part of the picture in one submission of about `targetSeconds`. Returns true once the picture
    // is whole; it then submits nothing. Pixels whose trace the driver ends early get kUnfinishedColor.
    bool advance(double targetSeconds = WorkSize::kTargetSeconds);

    bool isWhole() const { return nextTile == tiling.count; }

    // Returns the time that the device has spent on this picture, without the first submission of a pipeline,
    // in which the driver may compile it.
    double deviceSeconds() const { return seconds; }

    // Holds the pixels in the format of packedPixel, at index y * width + x. The buffer has room for
    // mostPixels, of which the picture fills the first width * height.
    const vulkan::Buffer& picture() const { return pixels; }

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
    std::vector<std::uint32_t> spirv; // replaces the embedded shader; empty: it does not
    std::vector<std::uint32_t> cellsSpirv;
    std::map<ViewReads, Program> programs; // created so far

    // The current picture.
    Program* program = nullptr;
    Tiling tiling{PixelRect{}}; // none yet
    std::uint32_t nextTile = 0;
    std::uint32_t view = 0;
    float scaleMax = 1.0f;
    float scaleMin = 0.0f;
    double seconds = 0.0;
};

} // namespace metamarch::render
