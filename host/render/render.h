// SPDX-License-Identifier: MIT
// A picture of a scene, by any integrator, on a device or on the CPU.
//
//     const PreparedScene scene = ...;  // once: structure and light
//     const DeviceScene onDevice(device, scene);
//     const RenderResult result = renderPicture(onDevice, camera, settings);
//     writePicture(result, origin, "picture.exr");
#pragma once
#include "metamarch/reference/rows.h"
#include "metamarch/render/device_scene.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch::render {

struct RenderSettings {
    PathChoice path;
    std::uint32_t samplesPerPixel = 64; // `primary` takes one
    std::string traversal;              // on a device; the CPU takes kd_stack

    bool isPrimary() const { return path.integrator == Integrator::primary; }
};

// What the picture's rays took.
struct RenderCounts {
    double rays = 0.0;
    double shadowRays = 0.0;
    double steps = 0.0; // of all rays
    double tests = 0.0;
    std::uint64_t hits = 0;     // pixels whose first sample meets something
    std::uint64_t rejected = 0; // samples that were not finite
};

struct RenderSeconds {
    double upload = 0.0;          // of the scene to the device
    double render = 0.0;          // wall time of renderPicture
    double firstSubmission = 0.0; // which may compile
    double device = 0.0;          // the others
};

struct RenderResult {
    RenderSettings settings; // that were asked for
    glm::uvec2 size{0};
    std::vector<FilmPixel> film; // in rows from the top
    bool isCancelled = false;    // some pixels have too few samples, or none

    std::string device; // its name, or "cpu"
    std::string driver;
    std::string traversal;
    RenderCounts counts;
    RenderSeconds seconds; // all but `render` are 0 on the CPU
    std::uint32_t submissions = 0;
    std::vector<std::string> warnings; // about this picture, one line each, for the user
};

// On the CPU, with the stack traversal. `onProgress` is called after each row. A cancelled picture is
// returned with the pixels that are there, and with isCancelled. Throws std::invalid_argument where the scene
// has no light, or light for another integrator.
RenderResult renderPicture(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
                           const OnProgress& onProgress = {});

// On the device. `onProgress` is called after each submission. Also throws what renderPathsOnDevice and
// SceneBuffers::makePipeline throw.
RenderResult renderPicture(const DeviceScene& scene, const Camera& camera, const RenderSettings& settings,
                           const OnProgress& onProgress = {});

} // namespace metamarch::render
