// SPDX-License-Identifier: MIT
// Renders a picture of a scene with any integrator, on a device or on the CPU.
//
//     const PreparedScene scene = ...;  // builds structure and light; serves any number of pictures
//     const DeviceScene onDevice(device, scene);
//     const RenderResult result = renderPicture(onDevice, camera, settings);
//     writePicture(result, origin, {"picture.exr"});
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/image/cryptomatte.h"
#include "metamarch/render/device_scene.h"
#include "metamarch/render/path_run.h"
#include "metamarch/render/seen_points.h"
#include "metamarch/shared/camera.h"
#include "metamarch/shared/film_data.h"

#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::render {

struct RenderSettings {
    PathChoice path;
    // The samples [firstSample, samplesPerPixel) of each pixel are taken: all, or a part of them. `primary`
    // always takes one.
    std::uint32_t firstSample = 0;
    std::uint32_t samplesPerPixel = 64;
    AdaptiveChoice adaptive{};       // only with firstSample 0; then samplesPerPixel is the most
    std::optional<PixelRect> area{}; // of the camera's picture; without one: all of it
    // The channels of the picture; empty: those that the integrator writes where nobody chooses.
    std::vector<Aov> channels{};
    // The value of the channels Z and t where a ray hits nothing.
    float missDepth = std::numeric_limits<float>::infinity();
    // For the channel `motion`; without it nothing moves.
    std::optional<NextFrame> next{};
    // Empty: on a device the one that marches the scene's table, on the CPU that of traversalOnCpu().
    std::string traversal{};

    bool isPrimary() const { return path.integrator == Integrator::primary; }
    AovWriter writer() const { return isPrimary() ? AovWriter::everyIntegrator : AovWriter::pathTracer; }
    std::vector<Aov> aovs() const { return channels.empty() ? usualAovs(writer()) : channels; }
};

// Totals over all rays of the picture.
struct RenderCounts {
    double samples = 0.0;
    double rays = 0.0;
    double shadowRays = 0.0;
    double steps = 0.0; // of all rays
    double tests = 0.0;
    std::uint64_t hits = 0;     // pixels whose first sample hits a triangle
    std::uint64_t rejected = 0; // samples that FilmPixel rejects
};

struct RenderSeconds {
    double upload = 0.0;          // upload of the scene to the device
    double render = 0.0;          // wall time of renderPicture
    double firstSubmission = 0.0; // the driver may compile the kernel in it
    double device = 0.0;          // all other submissions
};

// What drew a picture.
struct RenderPlace {
    std::string device; // its name, or "cpu"
    std::string driver;
    std::string traversal;
};

// Throws what traversalOnCpu() throws.
RenderPlace placeOnCpu(const RenderSettings& settings);
// Throws Error(invalidArgument) for a traversal that needs another table than the scene has.
RenderPlace placeOn(const DeviceScene& scene, const RenderSettings& settings);

struct RenderResult : RenderPlace {
    RenderSettings settings;   // as the caller gave them; samplesPerPixel is what every pixel has
    double samplesTaken = 0.0; // of all pixels, by this call
    glm::uvec2 size{0};        // of the whole picture
    PixelRect area;            // what `film` covers
    FilmData film;
    std::vector<SeenPoint> seen;               // of each pixel, if a channel needs it
    std::vector<CryptomatteLevel> cryptomatte; // of film.hits, if they are asked
    bool isCancelled = false;                  // some pixels have too few samples, or none
    // The same samples in the form from which a render goes on; only if the control keeps them, or if the
    // render is cancelled or failed.
    FilmRun sums;
    // Where the device was lost or its memory ran out: why. The film has what was finished.
    std::exception_ptr failure;

    RenderCounts counts;
    RenderSeconds seconds; // all but `render` are 0 on the CPU
    std::uint32_t submissions = 0;
    std::vector<std::string> warnings; // about this picture, one line each, for the user
};

// Renders on the CPU. Throws what traversalOnCpu() throws, Error(outOfMemory) if the kernel would read an
// array of more than 4 GiB, and std::invalid_argument if the integrator needs light and the scene has none,
// or was lit for another integrator.
RenderResult renderPicture(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
                           const RenderControl& control = {});

// Renders on the device. Also throws what the constructor of PathTracer and SceneBuffers::makePipeline throw.
RenderResult renderPicture(const DeviceScene& scene, const Camera& camera, const RenderSettings& settings,
                           const RenderControl& control = {});

} // namespace metamarch::render
