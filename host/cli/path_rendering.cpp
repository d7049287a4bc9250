#include "metamarch/cli/path_rendering.h"

#include "metamarch/cli/progress.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/image/film_image.h"
#include "metamarch/image/picture_header.h"
#include "metamarch/reference/path.h"
#include "metamarch/render/path_renderer.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/shading/shading.h"

#include <fmt/format.h>

#include <utility>

namespace metamarch::cli {
namespace {

std::vector<FilmPixel> renderOnCpu(const RenderJob& job, const ShadingScene& shading,
                                   const PathSettings& settings, const std::uint32_t samples,
                                   Rendering& result) {
    Progress progress("rendering", !job.quiet);
    const Stopwatch stopwatch;
    std::vector<FilmPixel> film =
        renderPathsOnCpu(job.structure, shading, settings, job.camera, samples, [&](const double part) {
            progress.show(part);
            return true;
        });
    describeCpu(result);
    result.stats["seconds"]["render"] = stopwatch.seconds();
    return film;
}

std::vector<FilmPixel> renderOnGpu(const RenderJob& job, const ShadingScene& shading,
                                   const PathSettings& settings, const std::uint32_t samples,
                                   Rendering& result) {
    const Stopwatch upload;
    const render::SceneBuffers scene(*job.device, job.structure, makeShadingData(job.scene));
    const render::ShadingBuffers buffers(*job.device, shading);
    result.stats["seconds"]["upload"] = upload.seconds();

    const Stopwatch stopwatch;
    DeviceProgress progress(!job.quiet);
    render::PathRender render = render::renderPathsOnDevice(
        *job.device, scene, buffers, job.traversal, settings, job.camera, samples, [&](const double part) {
            progress.show(part);
            return true;
        });
    describeDevice(job, scene, result);
    result.stats["seconds"]["render"] = stopwatch.seconds();
    result.stats["seconds"]["firstSubmission"] = render.firstSeconds;
    result.stats["seconds"]["device"] = render.deviceSeconds;
    result.stats["submissions"] = render.submissions;
    return std::move(render.film);
}

} // namespace

Rendering renderPaths(const RenderJob& job, const ShadingScene& shading, const PathSettings& settings,
                      const std::uint32_t samples) {
    Rendering result;
    const std::vector<FilmPixel> film = job.device != nullptr
                                            ? renderOnGpu(job, shading, settings, samples, result)
                                            : renderOnCpu(job, shading, settings, samples, result);
    double steps = 0.0;
    double tests = 0.0;
    double rays = 0.0;
    double shadowRays = 0.0;
    std::uint64_t rejected = 0;
    for (const FilmPixel& pixel : film) {
        steps += pixel.steps;
        tests += pixel.tests;
        rays += pixel.rays;
        shadowRays += pixel.shadowRays;
        rejected += pixel.rejected;
    }
    if (rejected > 0) {
        printWarning(fmt::format("{} samples were not finite and are left out", rejected));
    }
    const double seconds = result.stats["seconds"]["render"].get<double>();
    const double taken = static_cast<double>(film.size()) * samples;
    result.stats["samplesPerPixel"] = samples;
    result.stats["rejectedSamples"] = rejected;
    result.stats["rays"] = rays;
    result.stats["shadowRays"] = shadowRays;
    result.stats["stepsPerRay"] = steps / (rays + shadowRays);
    result.stats["testsPerRay"] = tests / (rays + shadowRays);
    result.stats["msamplesPerSecond"] = taken / seconds * 1e-6;
    result.stats["mraysPerSecond"] = (rays + shadowRays) / seconds * 1e-6;
    result.summary = fmt::format("{} samples a pixel, {:.2f} Msamples/s, {:.2f} Mrays/s", samples,
                                 taken / seconds * 1e-6, (rays + shadowRays) / seconds * 1e-6);
    result.image = filmImage(film, static_cast<int>(job.camera.width), static_cast<int>(job.camera.height),
                             aovsOf("path"));
    addSampling(result.image, samples, settings.seed, settings.maxBounces);
    return result;
}

} // namespace metamarch::cli
