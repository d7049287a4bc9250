#include "metamarch/cli/primary_rendering.h"

#include "metamarch/cli/progress.h"
#include "metamarch/image/film_image.h"
#include "metamarch/reference/primary.h"
#include "metamarch/render/primary_renderer.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/shading/shading.h"

#include <fmt/format.h>

namespace metamarch::cli {
namespace {

std::vector<FilmPixel> renderOnCpu(const RenderJob& job, const ShadingData& shading, Rendering& result) {
    Progress progress("rendering", !job.quiet);
    const Stopwatch stopwatch;
    std::vector<FilmPixel> pixels = renderPrimaryOnCpu(
        job.structure, shading.materials, shading.materialOfTriangle, job.camera, [&](const double part) {
            progress.show(part);
            return true;
        });
    describeCpu(result);
    result.stats["seconds"]["render"] = stopwatch.seconds();
    return pixels;
}

std::vector<FilmPixel> renderOnGpu(const RenderJob& job, const ShadingData& shading, Rendering& result) {
    const Stopwatch upload;
    const render::SceneBuffers scene(*job.device, job.structure, shading);
    result.stats["seconds"]["upload"] = upload.seconds();

    const Stopwatch stopwatch;
    DeviceProgress progress(!job.quiet);
    render::PrimaryRender render =
        render::renderPrimaryOnDevice(*job.device, scene, job.traversal, job.camera, [&](const double part) {
            progress.show(part);
            return true;
        });
    describeDevice(job, scene, result);
    result.stats["seconds"]["render"] = stopwatch.seconds();
    result.stats["seconds"]["firstSubmission"] = render.firstSeconds;
    result.stats["seconds"]["device"] = render.deviceSeconds;
    return std::move(render.pixels);
}

} // namespace

Rendering renderPrimary(const RenderJob& job) {
    const ShadingData shading = makeShadingData(job.scene);
    Rendering result;
    const std::vector<FilmPixel> pixels =
        job.device != nullptr ? renderOnGpu(job, shading, result) : renderOnCpu(job, shading, result);

    double steps = 0.0;
    double tests = 0.0;
    std::uint64_t hits = 0;
    for (const FilmPixel& pixel : pixels) {
        steps += pixel.steps;
        tests += pixel.tests;
        hits += pixel.seen.triangleId != kNoTriangle ? 1 : 0;
    }
    const auto rays = static_cast<double>(pixels.size());
    result.stats["rays"] = pixels.size();
    result.stats["hits"] = hits;
    result.stats["stepsPerRay"] = steps / rays;
    result.stats["testsPerRay"] = tests / rays;
    result.stats["mraysPerSecond"] = rays / result.stats["seconds"]["render"].get<double>() * 1e-6;
    result.summary = fmt::format("{:.2f} steps and {:.2f} tests per ray", steps / rays, tests / rays);
    result.image = filmImage(pixels, static_cast<int>(job.camera.width), static_cast<int>(job.camera.height),
                             aovsOf("primary"));
    return result;
}

} // namespace metamarch::cli
