#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/path_rendering.h"
#include "metamarch/cli/primary_rendering.h"
#include "metamarch/cli/structure_report.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/picture_header.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/scene/import.h"
#include "metamarch/settings/render_settings.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/lit_scene.h"
#include "metamarch/shading/view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>

namespace metamarch::cli {
namespace {

enum class Backend { gpu, cpu };

constexpr std::pair<std::string_view, Backend> kBackends[] = {{"gpu", Backend::gpu}, {"cpu", Backend::cpu}};

struct RenderOptions {
    std::string scenePath;
    std::string outputPath;
    glm::uvec2 size{1280, 720};
    ViewChoice view;
    ToneMapping tone{kToneNeutral};
    Backend backend = Backend::gpu;
    std::string device;
    std::string traversal; // empty: what marches the table
    PathChoice path;
    std::uint32_t samplesPerPixel = 64;
    LightChoice light;
    ImportOptions import;
    AccelerationOptions structure;
    std::string statsPath;
    bool quiet = false;
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

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    return weakly_canonical(absolute(a)) == weakly_canonical(absolute(b));
}

nlohmann::ordered_json makeStats(const Scene& scene, const AccelerationStructure& structure,
                                 const Rendering& rendering, const RenderOptions& options,
                                 const glm::uvec2 size) {
    nlohmann::ordered_json stats;
    stats["schema"] = 1;
    stats["device"] = rendering.device;
    stats["driver"] = rendering.driver;
    stats["traversal"] = rendering.traversal;
    stats["integrator"] = nameOf(options.path.integrator);
    stats["size"] = {size.x, size.y};
    stats.update(rendering.stats);
    stats["scene"] = reportStructure(scene, structure);
    if (rendering.rectilinear) {
        stats["scene"]["rectilinear"] = *rendering.rectilinear;
    }
    return stats;
}

Rendering tracePaths(const RenderJob& job, const RenderOptions& options) {
    const LitScene lit = lightScene(job.scene, options.scenePath, options.path, options.light);
    for (const std::string& warning : lit.warnings) {
        printWarning(warning);
    }
    return renderPaths(job, lit.shading, options.path.applied(lit.shading.settings), options.samplesPerPixel);
}

void runRender(const RenderOptions& options) {
    checkArguments(options);
    const glm::uvec2 size = options.size;
    checkWritable(options.outputPath);
    if (!options.statsPath.empty()) {
        const OutputFile probe(options.statsPath);
        if (sameFile(options.statsPath, options.outputPath)) {
            throw Error(ErrorKind::invalidArgument, "--stats and --output name the same file");
        }
    }

    const std::string traversal =
        options.traversal.empty() ? std::string(marchThrough(options.structure.table)) : options.traversal;
    requireTable(options.structure.table, traversal);

    // Before the long work, what can go wrong without it.
    std::optional<vulkan::Context> context;
    std::optional<vulkan::Device> device;
    if (options.backend == Backend::gpu) {
        context.emplace();
        device.emplace(*context, options.device);
        render::requireTraversal(device->report(), traversal);
    }

    const Stopwatch import;
    const Scene scene = loadScene(options.scenePath, options.import);
    const double importSeconds = import.seconds();
    printWarnings(scene);
    const SceneCamera sceneCamera =
        chooseCamera(scene, options.view, static_cast<float>(size.x) / static_cast<float>(size.y));
    const Camera camera = makeCamera(sceneCamera, size.x, size.y, options.view.lens);
    const Stopwatch build;
    const AccelerationStructure structure = buildAccelerationStructure(scene, options.structure);
    const double buildSeconds = build.seconds();
    printWarnings(scene, structure);
    const RenderJob job{scene, structure, camera, device ? &*device : nullptr, traversal, options.quiet};
    Rendering rendering =
        options.path.integrator == Integrator::primary ? renderPrimary(job) : tracePaths(job, options);

    rendering.stats["seconds"]["import"] = importSeconds;
    rendering.stats["seconds"]["build"] = buildSeconds;

    if (options.path.integrator != Integrator::primary &&
        std::filesystem::path(options.outputPath).extension() == ".png") {
        makeOpaque(rendering.image);
    }
    addHeader(rendering.image, {programVersion(), rendering.device, rendering.driver, rendering.traversal,
                                std::string(nameOf(options.path.integrator)), options.scenePath,
                                rendering.stats["seconds"]["render"].get<double>(), sceneCamera.name,
                                sceneCamera.eye, sceneCamera.forward, sceneCamera.up});
    const nlohmann::ordered_json stats = makeStats(scene, structure, rendering, options, size);
    writeImage(rendering.image, options.outputPath, options.tone);
    if (!options.statsPath.empty()) {
        // A driver may call its device by bytes that are no UTF-8.
        writeText(options.statsPath,
                  stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    }
    if (!options.quiet) {
        fmt::print("{}: {} x {}, {} triangles, {} on {} ({}), {:.2f} s, {}\n", options.outputPath, size.x,
                   size.y, scene.triangles.size(), rendering.traversal, rendering.device, rendering.driver,
                   rendering.stats["seconds"]["render"].get<double>(), rendering.summary);
    }
}

} // namespace

Command makeRenderCommand() {
    const auto options = std::make_shared<RenderOptions>();
    Command command{"render", "Render a scene to an EXR or PNG picture", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positional("SCENE", options->scenePath, "glTF, GLB, OBJ, PLY, OFF or STL file");
    settings.text("output", options->outputPath, "Picture to write: .exr (all channels) or .png")
        .shortly("o")
        .takes("FILE")
        .required();
    settings.size("size", options->size, "Width and height in pixels");
    settings.text("stats", options->statsPath, "Write what it took as JSON").takes("FILE.json");
    settings.flag("quiet", options->quiet, "Print nothing but errors and warnings");
    declareCamera(settings, options->view);
    declareTone(settings, options->tone);
    settings.beginGroup("Device");
    settings.choice("backend", options->backend, kBackends,
                    "gpu: Vulkan compute; cpu: the reference, a kd-tree walk");
    declareDevice(settings, options->device);
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
        runRender(*options);
    };
    return command;
}

} // namespace metamarch::cli
