// SPDX-License-Identifier: MIT
#include "metamarch/render/render.h"

#include "metamarch/reference/eye_media.h"
#include "metamarch/reference/path.h"
#include "metamarch/reference/primary.h"
#include "metamarch/render/path_renderer.h"
#include "metamarch/render/primary_renderer.h"
#include "metamarch/render/seen_points.h"
#include "metamarch/render/surface_groups.h"
#include "metamarch/render/traversal_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace metamarch::render {
namespace {

RenderCounts countOf(const std::vector<FilmPixel>& film) {
    RenderCounts counts;
    for (const FilmPixel& pixel : film) {
        counts.rays += pixel.rays;
        counts.shadowRays += pixel.shadowRays;
        counts.steps += pixel.steps;
        counts.tests += pixel.tests;
        counts.rejected += pixel.rejected;
        counts.hits += pixel.seen.triangleId != kNoTriangle ? 1 : 0;
    }
    return counts;
}

// `draw` fills the pixels of the result, and the members that say where and how they were made.
template <class Draw>
RenderResult renderBy(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
                      const OnProgress& onProgress, const Draw& draw) {
    if (!settings.isPrimary() &&
        !(scene.shading != nullptr && scene.shadingOptions == settings.path.shading())) {
        throw std::invalid_argument(
            fmt::format("renderPicture: the scene is not lit for {}", nameOf(settings.path.integrator)));
    }
    RenderResult result;
    result.settings = settings;
    result.size = {camera.width, camera.height};
    FilmRequest request{filmPartsOf(settings.aovs())};
    SurfaceGroups groups;
    if ((request.parts & kFilmHits) != 0) {
        groups = groupSurfaces(*scene.scene);
        request.groups = groups.ofTriangle;
        result.cryptomatte = groups.levels;
    }
    const OnProgress watch = [&](const double part) {
        const bool isOn = !onProgress || onProgress(part);
        result.isCancelled = !isOn && part < 1.0;
        return isOn;
    };
    PathSettings path{};
    if (!settings.isPrimary()) {
        path = settings.path.applied(scene.shading->settings);
        path.eyeMedia = mediaAt(*scene.structure, *scene.shading, camera.eye);
    }
    const Stopwatch stopwatch;
    draw(result, path, request, watch);
    result.seconds.render = stopwatch.seconds();
    result.counts = countOf(result.film.pixels);
    if (std::ranges::any_of(settings.aovs(), &Aov::isOfSeenPoint)) {
        result.seen = seenPoints(scene, camera, settings.isPrimary() ? nullptr : &path, result.film.pixels);
    }
    if (result.counts.rejected > 0) {
        result.warnings.push_back(
            fmt::format("{} samples were not finite and are left out", result.counts.rejected));
    }
    return result;
}

void take(DeviceRender render, RenderResult& result) {
    result.film = std::move(render.film);
    result.seconds.firstSubmission = render.firstSeconds;
    result.seconds.device = render.deviceSeconds;
    result.submissions = render.submissions;
}

} // namespace

RenderResult renderPicture(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
                           const OnProgress& onProgress) {
    const auto draw = [&](RenderResult& result, const PathSettings& path, const FilmRequest& request,
                          const OnProgress& watch) {
        result.device = "cpu";
        result.driver = "metamarch";
        result.traversal = "kd_stack";
        if (settings.isPrimary()) {
            const ShadingData shading = makeShadingData(*scene.scene);
            result.film.pixels = renderPrimaryOnCpu(*scene.structure, shading.materials,
                                                    shading.materialOfTriangle, camera, watch);
        } else {
            result.film = renderPathsOnCpu(*scene.structure, *scene.shading, path, camera,
                                           settings.samplesPerPixel, request, watch);
        }
    };
    return renderBy(scene, camera, settings, onProgress, draw);
}

RenderResult renderPicture(const DeviceScene& scene, const Camera& camera, const RenderSettings& settings,
                           const OnProgress& onProgress) {
    const auto draw = [&](RenderResult& result, const PathSettings& path, const FilmRequest& request,
                          const OnProgress& watch) {
        result.device = scene.device().name();
        result.driver = scene.device().report().driverInfo;
        const TableMethod table = scene.scene().structure->options.table;
        result.traversal = settings.traversal.empty() ? marchingTraversal(table) : settings.traversal;
        requireTable(table, result.traversal);
        result.seconds.upload = scene.uploadSeconds();
        if (settings.isPrimary()) {
            take(renderPrimaryOnDevice(scene.device(), scene.buffers(), result.traversal, camera, watch),
                 result);
        } else {
            take(renderPathsOnDevice(scene.device(), scene.buffers(), scene.shading(), result.traversal, path,
                                     camera, settings.samplesPerPixel, request, watch),
                 result);
        }
    };
    return renderBy(scene.scene(), camera, settings, onProgress, draw);
}

} // namespace metamarch::render
