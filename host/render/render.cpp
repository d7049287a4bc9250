// SPDX-License-Identifier: MIT
#include "metamarch/render/render.h"

#include "metamarch/error/error.h"
#include "metamarch/reference/eye_media.h"
#include "metamarch/reference/primary.h"
#include "metamarch/render/path_sampler.h"
#include "metamarch/render/primary_renderer.h"
#include "metamarch/render/surface_groups.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/compute_pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace metamarch::render {
namespace {

RenderCounts countOf(const std::vector<FilmPixel>& film) {
    RenderCounts counts;
    for (const FilmPixel& pixel : film) {
        counts.samples += pixel.samples;
        counts.rays += pixel.rays;
        counts.shadowRays += pixel.shadowRays;
        counts.steps += pixel.steps;
        counts.tests += pixel.tests;
        counts.rejected += pixel.rejected;
        counts.hits += pixel.seen.triangleId != kNoTriangle ? 1 : 0;
    }
    return counts;
}

// The pixels of `film`, which covers the whole picture, in the area.
std::vector<FilmPixel> cropped(const std::vector<FilmPixel>& film, const std::uint32_t width,
                               const PixelRect& area) {
    std::vector<FilmPixel> pixels;
    pixels.reserve(area.pixelCount());
    for (std::uint32_t y = area.top; y < area.bottom; ++y) {
        const auto row = film.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * width);
        pixels.insert(pixels.end(), row + area.left, row + area.right);
    }
    return pixels;
}

// The sums over all spans.
FilmData sumOf(const FilmRun& run) {
    FilmData film = *run.spans.front().film;
    for (std::size_t i = 1; i < run.spans.size(); ++i) {
        addBlock(film, *run.spans[i].film);
    }
    return film;
}

// One render while it lasts.
class Render {
  public:
    Render(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
           const RenderControl& control)
        : scene_(scene), camera_(camera), settings_(settings), control_(control) {
        if (!settings.isPrimary() &&
            !(scene.shading != nullptr && scene.shadingOptions == settings.path.shading())) {
            throw std::invalid_argument(
                fmt::format("renderPicture: the scene is not lit for {}", nameOf(settings.path.integrator)));
        }
        result_.settings = settings;
        request_.parts = filmPartsOf(settings.aovs()) | (settings.path.hasCatcher() ? kFilmLight : 0u);
        if ((request_.parts & kFilmHits) != 0) {
            groups_ = groupSurfaces(*scene.scene);
            request_.groups = groups_.ofTriangle;
            result_.cryptomatte = groups_.levels;
        }
        requireStartOfScene();
        result_.size = {camera.width, camera.height};
        result_.area = settings.area.value_or(PixelRect{0, 0, camera.width, camera.height});
    }

    RenderResult& result() { return result_; }

    PathWork work() const { return {pathSettings(), camera_, result_.area, request_}; }

    // `draw` gets an OnProgress and returns the film of the whole picture.
    template <class Draw>
    void drawPrimary(const Draw& draw) {
        const OnProgress onProgress = [&](const double part) {
            const auto pixels = static_cast<double>(std::size_t{camera_.width} * camera_.height);
            const RenderProgress progress{.part = part,
                                          .samples = part * pixels,
                                          .samplesLeft = (1.0 - part) * pixels,
                                          .nextSample = part < 1.0 ? 0u : 1u,
                                          .endSample = 1,
                                          .isPassEnd = part >= 1.0};
            const bool isOn = !control_.onStep || control_.onStep(progress) != RenderWish::stop;
            result_.isCancelled = !isOn && part < 1.0;
            return isOn;
        };
        result_.film.pixels = cropped(draw(onProgress), camera_.width, result_.area);
    }

    // What was taken before a failure of the device is kept. A device that is lost gives nothing back: then
    // the sums that were shown last are, or those that the render went on from.
    void drawPaths(PathSampler& sampler, const PathWork& work) {
        PathRun run(sampler, work, {settings_.firstSample, settings_.samplesPerPixel}, control_,
                    settings_.adaptive);
        FilmRun shown = control_.start;
        std::uint32_t shownNext = settings_.firstSample + run.samples();
        try {
            const auto show = [&](const RenderProgress& progress) {
                shown = run.sums();
                shownNext = progress.nextSample;
                showPicture(progress, shown);
            };
            result_.isCancelled = !run.take(show);
        } catch (const Error&) {
            result_.failure = std::current_exception();
            result_.isCancelled = true;
        }
        result_.settings.samplesPerPixel = settings_.firstSample + run.samples();
        FilmRun sums;
        try {
            sums = run.sums();
        } catch (const Error&) {
            sums = std::move(shown);
            result_.settings.samplesPerPixel = shownNext;
        }
        result_.film =
            sums.spans.empty() ? FilmData(work.area.pixelCount(), work.request.parts) : sumOf(sums);
        if (control_.keepsSums || result_.isCancelled) {
            result_.sums = std::move(sums);
        }
    }

    RenderResult finish() {
        result_.seconds.render = stopwatch_.seconds();
        lookAtFilm(result_);
        keepSeen(result_);
        result_.samplesTaken = result_.counts.samples - resumedSamples();
        if (result_.counts.rejected > 0) {
            result_.warnings.push_back(
                fmt::format("{} samples were not finite and are left out", result_.counts.rejected));
        }
        return std::move(result_);
    }

  private:
    // The start may come from anybody's file. Throws Error(inputRefused).
    void requireStartOfScene() const {
        const auto isOfScene = [&](const FilmPixel& pixel) {
            return pixel.seen.triangleId == kNoTriangle ||
                   pixel.seen.triangleId < scene_.scene->triangles.size();
        };
        const std::size_t groups = groups_.levels.empty() ? 0 : groups_.levels.front().nameOfGroup.size();
        const auto isOfGroups = [&](const std::vector<HitCount>& hits) {
            return std::ranges::all_of(hits, [&](const HitCount& hit) { return hit.group < groups; });
        };
        for (const FilmSpan& span : control_.start.spans) {
            const FilmData& film = *span.film;
            if (film.parts() != request_.parts || !std::ranges::all_of(film.pixels, isOfScene) ||
                !std::ranges::all_of(film.hits, isOfGroups)) {
                throw Error(ErrorKind::inputRefused, "the sums to go on from are of another scene",
                            {"resume"});
            }
        }
    }

    PathSettings pathSettings() const {
        PathSettings path = settings_.path.applied(scene_.shading->settings);
        path.eyeMedia = mediaAt(*scene_.structure, *scene_.shading, camera_.eye);
        return path;
    }

    // What the channels of the picture need besides its film.
    void lookAtFilm(RenderResult& result) const {
        result.counts = countOf(result.film.pixels);
        if (settings_.firstSample == 0 && std::ranges::any_of(settings_.aovs(), &Aov::isOfSeenPoint)) {
            const std::optional<PathSettings> path =
                settings_.isPrimary() ? std::nullopt : std::optional(pathSettings());
            result.seen = seenPoints(scene_, camera_, result.area, path ? &*path : nullptr,
                                     result.film.pixels, settings_.next ? &*settings_.next : nullptr);
        }
    }

    // A picture that is put together of such sums has no scene to look at.
    static void keepSeen(RenderResult& result) {
        if (!result.sums.spans.empty() && result.sums.spans.front().firstSample == 0) {
            result.sums.seen = result.seen;
        }
    }

    double resumedSamples() const {
        double samples = 0.0;
        for (const FilmSpan& span : control_.start.spans) {
            samples += countOf(span.film->pixels).samples;
        }
        return samples;
    }

    void showPicture(const RenderProgress& progress, const FilmRun& sums) {
        if (!control_.onShow) {
            return;
        }
        RenderResult picture = result_;
        picture.isCancelled = !progress.isPassEnd || progress.nextSample < progress.endSample;
        picture.film = sumOf(sums);
        picture.sums = sums;
        picture.settings.samplesPerPixel = progress.nextSample;
        picture.seconds.render = stopwatch_.seconds();
        lookAtFilm(picture);
        keepSeen(picture);
        control_.onShow(progress, picture);
    }

    const PreparedScene& scene_;
    const Camera& camera_;
    const RenderSettings& settings_;
    const RenderControl& control_;
    Stopwatch stopwatch_;
    SurfaceGroups groups_;
    FilmRequest request_; // refers to groups_
    RenderResult result_;
};

RenderResult drawOnDevice(const DeviceScene& scene, const Camera& camera, const RenderSettings& settings,
                          const RenderControl& control) {
    Render render(scene.scene(), camera, settings, control);
    RenderResult& result = render.result();
    static_cast<RenderPlace&>(result) = placeOn(scene, settings);
    result.seconds.upload = scene.uploadSeconds();
    std::uint64_t spilled = 0;
    if (settings.isPrimary()) {
        render.drawPrimary([&](const OnProgress& onProgress) {
            DeviceRender drawn =
                renderPrimaryOnDevice(scene.device(), scene.buffers(), result.traversal, camera, onProgress);
            result.seconds.firstSubmission = drawn.firstSeconds;
            result.seconds.device = drawn.deviceSeconds;
            result.submissions = drawn.submissions;
            return std::move(drawn.film.pixels);
        });
        spilled = scene.device().memoryUse().spilled;
    } else {
        const PathWork work = render.work();
        DevicePathSampler sampler(scene.device(), scene.buffers(), scene.shading(), result.traversal, work);
        render.drawPaths(sampler, work);
        spilled = scene.device().memoryUse().spilled; // with the film
        result.seconds.firstSubmission = sampler.counters().firstSeconds;
        result.seconds.device = sampler.counters().deviceSeconds;
        result.submissions = sampler.counters().submissions;
    }
    if (spilled > 0) {
        result.warnings.push_back(fmt::format(
            "{} find no place in the memory of {}; they lie in host memory, which it reads more slowly",
            vulkan::byteText(spilled), scene.device().name()));
    }
    return render.finish();
}

} // namespace

RenderPlace placeOnCpu(const RenderSettings& settings) {
    return {"cpu", "metamarch", traversalOnCpu(settings.traversal)};
}

RenderPlace placeOn(const DeviceScene& scene, const RenderSettings& settings) {
    const TableMethod table = scene.scene().structure->options.table;
    const std::string traversal =
        settings.traversal.empty() ? std::string(marchingTraversal(table)) : settings.traversal;
    requireTable(table, traversal);
    return {scene.device().name(), scene.device().report().driverText(), traversal};
}

RenderResult renderPicture(const PreparedScene& scene, const Camera& camera, const RenderSettings& settings,
                           const RenderControl& control) {
    Render render(scene, camera, settings, control);
    static_cast<RenderPlace&>(render.result()) = placeOnCpu(settings);
    const bool isByJudge = render.result().traversal == "kd_stack";
    if (settings.isPrimary()) {
        const ShadingData shading = makeShadingData(*scene.scene);
        render.drawPrimary([&](const OnProgress& onProgress) {
            return isByJudge ? renderPrimaryByJudge(*scene.structure, shading.materials,
                                                    shading.materialOfTriangle, camera, onProgress)
                             : renderPrimaryOnCpu(*scene.structure, shading, camera, onProgress);
        });
    } else {
        const PathWork work = render.work();
        std::unique_ptr<PathSampler> sampler;
        if (isByJudge) {
            sampler = std::make_unique<JudgePathSampler>(*scene.structure, *scene.shading, work);
        } else {
            sampler = std::make_unique<CpuPathSampler>(*scene.structure, *scene.shading, work);
        }
        render.drawPaths(*sampler, work);
    }
    return render.finish();
}

RenderResult renderPicture(const DeviceScene& scene, const Camera& camera, const RenderSettings& settings,
                           const RenderControl& control) {
    try {
        return drawOnDevice(scene, camera, settings, control);
    } catch (const vulkan::BindingOverLimit& error) {
        throw Error(error.kind, fmt::format("{}; the backend cpu has no such limit", error.what()),
                    {"backend"});
    }
}

} // namespace metamarch::render
