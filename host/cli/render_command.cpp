// SPDX-License-Identifier: MIT
#include "metamarch/cli/render_command.h"

#include "metamarch/cli/checkpoint.h"
#include "metamarch/cli/commands.h"
#include "metamarch/cli/film_facts.h"
#include "metamarch/cli/next_frame.h"
#include "metamarch/cli/process.h"
#include "metamarch/cli/render_options.h"
#include "metamarch/cli/render_report.h"
#include "metamarch/cli/render_watch.h"
#include "metamarch/cli/rendered_picture.h"
#include "metamarch/cli/stage_log.h"
#include "metamarch/cli/structure_report.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/picture.h"
#include "metamarch/render/render.h"
#include "metamarch/render/surface_groups.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/scene/file_digest.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/view.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <vector>

namespace metamarch::cli {
namespace {

// Writes `report`, which says what the rendering took, with a description of the scene.
void writeStats(const nlohmann::ordered_json& report, const render::PreparedScene& scene,
                const std::optional<render::DeviceScene>& onDevice, const std::string& path) {
    nlohmann::ordered_json stats;
    stats["schema"] = 1;
    stats.update(report);
    stats["scene"] = reportStructure(*scene.scene, *scene.structure);
    if (onDevice && report["traversal"] == render::marchingTraversal(TableMethod::rectilinear)) {
        stats["scene"]["rectilinear"] =
            reportRectilinear(onDevice->buffers().structures().rectilinearTable());
    }
    // The name of a device may hold bytes that are no UTF-8.
    writeText(path, stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

// Then the summary is left out: standard output holds the result alone.
bool printsResults(const RenderOptions& options) {
    return isStandardOutput(options.outputPath) ||
           (!options.statsPath.empty() && isStandardOutput(options.statsPath));
}

// One render and what it writes.
class RenderJob {
  public:
    // `options` are what `given` sets.
    RenderJob(RenderOptions& options, const SettingList& given)
        : options_(options), given_(given), log_(options.isVerbose) {}

    void run();

  private:
    void openDevice();
    void openCheckpoint();
    void loadScene();
    void render();
    void write(const render::RenderResult& result);
    void writeWhileRunning(const render::RenderResult& result);
    bool isComplete(const render::RenderResult& result) const;
    void writeAtEnd(const render::RenderResult& result);
    void endEarly(const render::RenderResult& result, int signal);
    void report(const render::RenderResult& result);

    // The first, so that the limit outlives all that has threads.
    std::optional<Threads> threads_;
    RenderOptions& options_;
    const SettingList& given_;
    StageLog log_;
    render::RenderSettings settings_;
    std::optional<Denoiser> denoiser_;
    std::optional<vulkan::Context> context_;
    std::optional<vulkan::Device> device_;
    std::optional<Checkpoint> checkpoint_;
    std::optional<render::FilmFile> resumed_;
    std::shared_ptr<const Scene> scene_;
    SceneCamera sceneCamera_;
    Camera camera_{};
    std::optional<render::PreparedScene> prepared_;
    std::optional<render::DeviceScene> onDevice_;
    render::FilmFile sums_; // of parts and checkpoints, without runs
    std::string sceneSha1_; // of the scene's file; empty for standard input
    double importSeconds_ = 0.0;
    double buildSeconds_ = 0.0;
};

// Before the long work: there may be no device that fits.
void RenderJob::openDevice() {
    if (options_.backend == Backend::gpu) {
        context_.emplace();
        device_.emplace(*context_, options_.device);
        render::requireTraversal(device_->report(), settings_.traversal);
        log_.end(fmt::format("device {}, {} {}", device_->name(), device_->report().driver,
                             device_->report().driverInfo));
    }
}

void RenderJob::openCheckpoint() {
    if (!options_.checkpointPath.empty()) {
        checkpoint_.emplace(options_.checkpointPath, options_.resumePath);
    }
    if (!options_.resumePath.empty()) {
        resumed_ = render::readFilmFile(options_.resumePath);
    }
}

void RenderJob::loadScene() {
    const Stopwatch import;
    const auto scene = std::make_shared<Scene>(metamarch::loadScene(options_.scenePath, options_.import));
    scene_ = scene;
    importSeconds_ = import.seconds();
    sceneSha1_ = isStandardInput(options_.scenePath) ? "" : sha1Of(options_.scenePath);
    printWarnings(scene_->warnings);
    checkOutputsDiffer(outputsOf(options_), companionsOf(*scene_));
    log_.end(fmt::format("scene of {} triangles, {} materials, {} textures", scene_->triangles.size(),
                         scene_->materials.size(), scene_->textures.size()));
    const glm::vec2 size(options_.size);
    sceneCamera_ = chooseCamera(*scene_, options_.view, size.x / size.y);
    camera_ = makeCamera(sceneCamera_, options_.size.x, options_.size.y, options_.view.lens);
    if (hasMotion(options_)) {
        settings_.next = nextFrame(options_, *scene_, sceneCamera_, [&](const ImportOptions& later) {
            return std::make_shared<const Scene>(metamarch::loadScene(options_.scenePath, later));
        });
        log_.end("scene of the next frame");
    }
    if (options_.catcher.isOn()) { // after the camera, which frames the objects
        settings_.path.catcher = placeCatcher(*scene, options_.catcher);
    }
    const Stopwatch build;
    prepared_.emplace(scene_, options_.structure);
    buildSeconds_ = build.seconds();
    printWarnings(render::warningsOf(*prepared_->structure));
    log_.end("tree and table");
    if (!settings_.isPrimary()) {
        prepared_->light(options_.scenePath, settings_.path, options_.light);
        printWarnings(prepared_->lightWarnings);
        log_.end("light and materials");
    }
    if (device_) {
        onDevice_.emplace(*device_, *prepared_);
        log_.end("scene on the device");
    }
}

void RenderJob::write(const render::RenderResult& result) {
    if (isPart(options_)) {
        writeFilmFile(sums_, {&result.sums, 1}, options_.outputPath);
        return;
    }
    if (denoiser_) {
        try {
            writeRenderedPicture(result, options_, given_, sceneCamera_, sceneSha1_, &*denoiser_);
            return;
        } catch (const Error& error) {
            if (error.settings != std::vector<std::string>{"denoise"}) {
                throw;
            }
            printWarnings({fmt::format("{}; the picture keeps its noise", error.what())});
        }
    }
    writeRenderedPicture(result, options_, given_, sceneCamera_, sceneSha1_, nullptr);
}

// A stream takes one picture, the last.
void RenderJob::writeWhileRunning(const render::RenderResult& result) {
    if (!OutputTarget(options_.outputPath).isStream()) {
        write(result);
    }
}

bool RenderJob::isComplete(const render::RenderResult& result) const {
    return !result.isCancelled && result.settings.samplesPerPixel == settings_.samplesPerPixel;
}

// If one of picture and checkpoint cannot be written, the other still is.
void RenderJob::writeAtEnd(const render::RenderResult& result) {
    const bool hasSums = checkpoint_ && !result.sums.spans.empty();
    std::exception_ptr checkpointFailure;
    if (hasSums && !isComplete(result)) {
        try {
            checkpoint_->write(sums_, result.sums);
        } catch (...) {
            checkpointFailure = std::current_exception();
        }
    }
    try {
        write(result);
    } catch (...) {
        if (hasSums && isComplete(result)) {
            checkpoint_->write(sums_, result.sums);
        }
        throw;
    }
    if (checkpointFailure) {
        std::rethrow_exception(checkpointFailure);
    }
    log_.end(fmt::format("{} written", options_.outputPath));
    if (checkpoint_ && isComplete(result)) {
        checkpoint_->remove();
    }
}

void RenderJob::endEarly(const render::RenderResult& result, const int signal) {
    const std::string& sums = checkpoint_        ? options_.checkpointPath
                              : isPart(options_) ? options_.outputPath
                                                 : "";
    // In the middle of a pass some pixels have more samples than others.
    const std::uint32_t fewest = result.settings.samplesPerPixel;
    const std::uint32_t most = result.settings.firstSample + result.film.samples();
    const std::string samples =
        most > fewest ? fmt::format("{} to {}", fewest, most) : fmt::format("{}", fewest);
    printError(fmt::format("metamarch: ended by signal {}: {} has {} of {} samples a pixel; {}\n", signal,
                           options_.outputPath, samples, settings_.samplesPerPixel,
                           sums.empty() ? "with --checkpoint FILE a render can go on"
                                        : fmt::format("go on with --resume {}", sums)));
    endBy(signal);
}

void RenderJob::report(const render::RenderResult& result) {
    if (!options_.statsPath.empty()) {
        nlohmann::ordered_json stats = reportRender(result);
        stats["seconds"]["import"] = importSeconds_;
        stats["seconds"]["build"] = buildSeconds_;
        stats["options"] = given_.changedText(settingsOfTheRun());
        writeStats(stats, *prepared_, onDevice_, options_.statsPath);
    }
    if (!options_.quiet && !printsResults(options_)) {
        printSummary(fmt::format("{}: {} x {}, {} triangles, {} on {} ({}), {:.2f} s, {}\n",
                                 options_.outputPath, result.area.width(), result.area.height(),
                                 scene_->triangles.size(), result.traversal, result.device, result.driver,
                                 result.seconds.render, summaryOf(result)));
    }
}

void RenderJob::render() {
    const PixelRect area = settings_.area.value_or(PixelRect{0, 0, options_.size.x, options_.size.y});
    render::RenderControl control;
    if (checkpoint_ || resumed_ || isPart(options_)) {
        const render::RenderPlace place =
            onDevice_ ? placeOn(*onDevice_, settings_) : render::placeOnCpu(settings_);
        sums_ = {.facts = factsOf(*prepared_, sceneCamera_, place, given_),
                 .sceneFile = options_.scenePath,
                 .width = options_.size.x,
                 .height = options_.size.y,
                 .cryptomatte = {},
                 .runs = {}};
        if (std::ranges::any_of(settings_.aovs(), &Aov::isCryptomatte)) {
            sums_.cryptomatte = render::groupSurfaces(*scene_).levels;
        }
        sums_.facts.emplace_back("sceneSha1", sceneSha1_);
    }
    if (resumed_) {
        control.start = takeRun(std::move(*resumed_), options_.resumePath, sums_, area,
                                {settings_.firstSample, settings_.samplesPerPixel});
    }
    if (checkpoint_) {
        checkpoint_->write(sums_, control.start.spans.empty() ? render::FilmRun{area, {}} : control.start);
    }
    control.keepsSums = checkpoint_ || isPart(options_);
    control.timeLimit = options_.timeLimit.value_or(control.timeLimit);

    RenderWatch::WriteCheckpoint writeCheckpoint;
    if (checkpoint_) {
        writeCheckpoint = [this](const render::FilmRun& run) { checkpoint_->write(sums_, run); };
    }
    std::optional<RenderWatch> watch(
        std::in_place,
        RenderWatch::Choice{.progress = options_.quiet ? ProgressForm::none : options_.progress,
                            .writeEvery = options_.writeEvery,
                            .isOnDevice = onDevice_.has_value()},
        [this](const render::RenderResult& result) { writeWhileRunning(result); }, writeCheckpoint);
    watch->follow(control);
    const render::RenderResult result = onDevice_ ? renderPicture(*onDevice_, camera_, settings_, control)
                                                  : renderPicture(*prepared_, camera_, settings_, control);
    watch->endProgress();
    printWarnings(result.warnings);
    log_.end(onDevice_
                 ? fmt::format("picture, of which {:.3f} s until the first result (the driver compiles)",
                               result.seconds.firstSubmission)
                 : "picture");
    if (!result.failure || result.film.samples() > 0) {
        writeAtEnd(result);
    }
    if (result.failure) {
        std::rethrow_exception(result.failure);
    }
    if (watch->signal() != 0) {
        endEarly(result, watch->signal());
    }
    report(result);
}

void RenderJob::run() {
    checkArguments(options_);
    checkOutputs(options_, given_);
    threads_.emplace(options_.threads);
    settings_ = settingsOf(options_);
    if (options_.isDenoised) {
        denoiser_.emplace();
    }
    openCheckpoint();
    openDevice();
    loadScene();
    render();
}

} // namespace

void writeMerged(const render::FilmFile& file, const std::string& name, FilmData film,
                 std::vector<SeenPoint> seen, const std::uint32_t samples, const std::string& output) {
    RenderOptions options;
    SettingList settings;
    declareRender(settings, options);
    applyFacts(file.facts, name, settings);
    chooseTone(settings, options.path.integrator, options.tone);
    options.samplesPerPixel = samples;
    options.outputPath = output;
    checkFormat(options);
    render::RenderResult result;
    static_cast<render::RenderPlace&>(result) = placeIn(file.facts);
    result.settings = settingsOf(options);
    const std::vector<Aov> aovs = result.settings.aovs();
    const bool hasHits = !film.hits.empty();
    // The catcher's shadow is among the sums of light.
    const std::uint32_t parts = filmPartsOf(aovs) | (options.catcher.isOn() ? kFilmLight : 0u);
    if (film.parts() != parts || hasHits == file.cryptomatte.empty() ||
        seen.empty() == std::ranges::any_of(aovs, &Aov::isOfSeenPoint)) {
        throw Error(ErrorKind::inputRefused, name + ": lacks sums for the channels of its picture");
    }
    result.size = {file.width, file.height};
    result.area = {0, 0, file.width, file.height};
    result.film = std::move(film);
    result.seen = std::move(seen);
    result.cryptomatte = file.cryptomatte;
    render::writePicture(result,
                         {.software = render::factNamed(file.facts, "version"),
                          .sceneFile = file.sceneFile,
                          .camera = cameraIn(file.facts, name),
                          .options = settings.changedText(settingsOfTheRun()),
                          .sceneSha1 = render::factNamed(file.facts, "sceneSha1"),
                          .lens = options.view.lens},
                         {output, options.tone, options.storage});
}

Command makeRenderCommand() {
    const auto options = std::make_shared<RenderOptions>();
    Command command{"render", "Render a scene to a picture", {}, {}, {}, {}};
    declareRender(command.settings, *options);
    command.footer =
        "Pixel (0,0) is top left.\n\n"
        "Example:\n  build/metamarch render scenes/objects.glb -o build/objects.exr --size 640x360 --spp 16";
    command.run = [options](const SettingList& given) {
        chooseTone(given, options->path.integrator, options->tone);
        RenderJob(*options, given).run();
    };
    return command;
}

} // namespace metamarch::cli
