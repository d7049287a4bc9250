// SPDX-License-Identifier: MIT
#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/file_digest.h"
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/picture_options.h"
#include "metamarch/cli/progress.h"
#include "metamarch/cli/render_report.h"
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
#include "metamarch/render/traversal_choice.h"
#include "metamarch/scene/import.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace metamarch::cli {
namespace {

enum class Backend { gpu, cpu };

constexpr std::pair<std::string_view, Backend> kBackends[] = {{"gpu", Backend::gpu}, {"cpu", Backend::cpu}};

struct RenderOptions : PictureOptions {
    RenderOptions() : PictureOptions(64) {}

    std::string outputPath;
    std::vector<std::string> aovs; // empty: what the integrator writes where nobody chooses
    float missDepth = std::numeric_limits<float>::infinity();
    PictureStorage storage;
    Backend backend = Backend::gpu;
    std::string statsPath;
    bool isStamped = false;
    bool quiet = false;
    bool isVerbose = false;
};

void checkArguments(const RenderOptions& options) {
    if (options.backend == Backend::cpu && !(options.device.empty() && options.traversal.empty())) {
        throw Error(
            ErrorKind::invalidArgument,
            "--backend cpu walks the kd-tree with a stack on the processor; --device and --traversal are "
            "for the gpu");
    }
    checkView(options.view, options.path.integrator);
    checkStructure(options.structure);
}

render::RenderSettings settingsOf(const RenderOptions& options) {
    render::RenderSettings settings;
    settings.path = options.path;
    settings.samplesPerPixel = options.samplesPerPixel;
    settings.traversal = options.traversal;
    settings.missDepth = options.missDepth;
    if (!options.aovs.empty()) {
        settings.channels = chooseAovs(options.aovs, settings.writer());
    }
    if (!settings.traversal.empty()) {
        render::requireTable(options.structure.table, settings.traversal); // before the scene is loaded
    }
    return settings;
}

void checkChannels(const RenderOptions& options) {
    if (pictureFormatOf(options.outputPath, options.storage) != PictureFormat::exr) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("{}: only an EXR has further channels", options.outputPath), {"aov"});
    }
    const std::vector<Aov> chosen = settingsOf(options).aovs();
    const auto staysExact = [](const Aov& aov) { return aov.isCryptomatte() || aov.name() == "P"; };
    if (std::ranges::any_of(chosen, staysExact) && !options.storage.exr.isMultipart &&
        options.storage.exr.compression == ExrCompression::dwaa) {
        refuseLossyIds();
    }
}

std::vector<NamedFile> outputsOf(const RenderOptions& options) {
    return {{"--output", options.outputPath}, {"--stats", options.statsPath}};
}

// Refuses bad outputs before the long work.
void checkOutputs(const RenderOptions& options, const SettingList& given) {
    checkWritable(options.outputPath, options.storage);
    if (!options.aovs.empty()) {
        checkChannels(options);
    }
    if (options.path.isTransparent &&
        pictureFormatOf(options.outputPath, options.storage) == PictureFormat::jpeg) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("{}: a JPEG cannot be transparent", options.outputPath), {"transparent"});
    }
    if (!options.statsPath.empty()) {
        const OutputFile probe(options.statsPath);
    }
    const NamedFile inputs[] = {{"SCENE", options.scenePath},
                                {"--env", given.at("env").text()},
                                {"--partition", given.at("partition").text()}};
    checkOutputsDiffer(outputsOf(options), inputs);
}

// Renders on the device, or on the CPU if there is no `onDevice`.
render::RenderResult renderWithProgress(const render::PreparedScene& scene,
                                        const std::optional<render::DeviceScene>& onDevice,
                                        const Camera& camera, const render::RenderSettings& settings,
                                        const bool quiet) {
    Progress bar(onDevice ? "compiling" : "rendering", !quiet);
    const auto show = [&](const double part) {
        bar.show("rendering", part);
        return true;
    };
    return onDevice ? render::renderPicture(*onDevice, camera, settings, show)
                    : render::renderPicture(scene, camera, settings, show);
}

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

// Returns the options that change the picture. The preset is left out, because it stands for other settings.
std::string changedOptions(const SettingList& given) {
    constexpr std::string_view kOutputs[] = {"output",  "stats",   "stamp", "quiet",
                                             "verbose", "threads", "preset"};
    return given.changedText(kOutputs);
}

void runRender(const RenderOptions& options, const SettingList& given) {
    checkArguments(options);
    const glm::uvec2 size = options.size;
    checkOutputs(options, given);
    const Threads threads(options.threads);
    StageLog log(options.isVerbose);
    const render::RenderSettings settings = settingsOf(options);

    // Chosen before the long work, because there may be no device that fits.
    std::optional<vulkan::Context> context;
    std::optional<vulkan::Device> device;
    if (options.backend == Backend::gpu) {
        context.emplace();
        device.emplace(*context, options.device);
        render::requireTraversal(device->report(), settings.traversal);
        log.end(fmt::format("device {}, {} {}", device->name(), device->report().driver,
                            device->report().driverInfo));
    }

    const Stopwatch import;
    const auto scene = std::make_shared<const Scene>(loadScene(options.scenePath, options.import));
    const double importSeconds = import.seconds();
    printWarnings(scene->warnings);
    checkOutputsDiffer(outputsOf(options), companionsOf(*scene));
    log.end(fmt::format("scene of {} triangles, {} materials, {} textures", scene->triangles.size(),
                        scene->materials.size(), scene->textures.size()));
    const SceneCamera sceneCamera =
        chooseCamera(*scene, options.view, static_cast<float>(size.x) / static_cast<float>(size.y));
    const Camera camera = makeCamera(sceneCamera, size.x, size.y, options.view.lens);
    const Stopwatch build;
    render::PreparedScene prepared(scene, options.structure);
    const double buildSeconds = build.seconds();
    printWarnings(render::warningsOf(*prepared.structure));
    log.end("tree and table");
    if (!settings.isPrimary()) {
        prepared.light(options.scenePath, settings.path, options.light);
        printWarnings(prepared.lightWarnings);
        log.end("light and materials");
    }
    std::optional<render::DeviceScene> onDevice;
    if (device) {
        onDevice.emplace(*device, prepared);
        log.end("scene on the device");
    }

    const render::RenderResult result =
        renderWithProgress(prepared, onDevice, camera, settings, options.quiet);
    printWarnings(result.warnings);
    log.end(onDevice ? fmt::format("picture, of which {:.3f} s until the first result (the driver compiles)",
                                   result.seconds.firstSubmission)
                     : "picture");
    render::writePicture(result,
                         {.software = programVersion(),
                          .sceneFile = options.scenePath,
                          .camera = sceneCamera,
                          .options = changedOptions(given),
                          .isStamped = options.isStamped,
                          .sceneSha1 = isStandardInput(options.scenePath) ? "" : sha1Of(options.scenePath),
                          .lens = options.view.lens},
                         options.outputPath, options.tone, options.storage);
    log.end(fmt::format("{} written", options.outputPath));
    if (!options.statsPath.empty()) {
        nlohmann::ordered_json report = reportRender(result);
        report["seconds"]["import"] = importSeconds;
        report["seconds"]["build"] = buildSeconds;
        report["options"] = changedOptions(given);
        writeStats(report, prepared, onDevice, options.statsPath);
    }
    if (!options.quiet && !printsResults(options)) {
        printSummary(fmt::format("{}: {} x {}, {} triangles, {} on {} ({}), {:.2f} s, {}\n",
                                 options.outputPath, size.x, size.y, scene->triangles.size(),
                                 result.traversal, result.device, result.driver, result.seconds.render,
                                 summaryOf(result)));
    }
}

} // namespace

Command makeRenderCommand() {
    const auto options = std::make_shared<RenderOptions>();
    Command command{"render", "Render a scene to a picture", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positional("SCENE", options->scenePath,
                        "glTF, GLB, OBJ, PLY, OFF or STL file; -: a GLB from standard input");
    settings
        .text("output", options->outputPath,
              "Picture to write: .exr (all channels), .png, .jpg, .webp or .tif; -: to standard output, as "
              "--format "
              "says (exr)")
        .withShortName("o")
        .withValueName("FILE")
        .required();
    settings.size("size", options->size, "Width and height in pixels");
    settings.text("stats", options->statsPath, "Write what it took as JSON; -: to standard output")
        .withValueName("FILE.json");
    settings.flag("stamp", options->isStamped,
                  "Say in an EXR's header when it was made and how long that took");
    settings.flag("quiet", options->quiet, "Print nothing but errors and warnings");
    settings
        .flag("verbose", options->isVerbose,
              "Also print the device, and each stage with its seconds, on standard error")
        .excludes({"quiet"});
    declareChannels(settings, options->aovs, options->missDepth);
    settings.flag(
        "transparent", options->path.isTransparent,
        "The camera does not see the background or the environment, which light the scene all the same");
    declareStorage(settings, options->storage);
    declareCamera(settings, options->view);
    declareTone(settings, options->tone);
    settings.beginGroup("Device");
    settings.choice("backend", options->backend, kBackends,
                    "gpu: Vulkan compute; cpu: the reference, a kd-tree walk");
    declareDevice(settings, options->device);
    declareThreads(settings, options->threads);
    declareTraversal(settings, "traversal", options->traversal,
                     fmt::format("How rays find triangles (default {}, or what marches --table): {}",
                                 traversals().front(), fmt::join(traversals(), " ")));
    declareIntegrator(settings, options->path, std::size(kIntegrators));
    declarePath(settings, options->path, options->samplesPerPixel);
    declareLight(settings, options->light);
    declareImport(settings, options->import);
    declareStructure(settings, options->structure);
    command.footer =
        "Pixel (0,0) is top left.\n\n"
        "Example:\n  build/metamarch render scenes/objects.glb -o build/objects.exr --size 640x360 --spp 16";
    command.run = [options](const SettingList& given) {
        chooseTone(given, options->path.integrator, options->tone);
        runRender(*options, given);
    };
    return command;
}

} // namespace metamarch::cli
