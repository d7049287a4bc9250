#include "metamarch/cli/render_command.h"

#include "metamarch/cli/light_options.h"
#include "metamarch/cli/number_list.h"
#include "metamarch/cli/path_options.h"
#include "metamarch/cli/path_rendering.h"
#include "metamarch/cli/primary_rendering.h"
#include "metamarch/cli/scene_options.h"
#include "metamarch/cli/structure_options.h"
#include "metamarch/cli/structure_report.h"
#include "metamarch/cli/tone_options.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/view_options.h"
#include "metamarch/cli/warnings.h"
#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/picture_header.h"
#include "metamarch/render/scene_buffers.h"
#include "metamarch/render/stopwatch.h"
#include "metamarch/scene/import.h"
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

struct RenderOptions {
    std::string scenePath;
    std::string outputPath;
    std::string size = "1280x720";
    ViewOptions camera;
    ToneOptions tone;
    std::string backend = "gpu";
    std::string device;
    std::string traversal;
    std::string integrator = "path";
    PathOptions path{64};
    LightOptions light;
    SceneOptions scene;
    StructureOptions structure;
    std::string statsPath;
    bool quiet = false;
};

void checkArguments(const RenderOptions& options) {
    if (options.backend == "cpu" && !(options.device.empty() && options.traversal.empty())) {
        throw Error(
            ErrorKind::invalidArgument,
            "--backend cpu walks the kd-tree with a stack on the processor; --device and --traversal are "
            "for the gpu");
    }
    options.camera.check(options.integrator);
    options.path.check();
    options.light.check();
    options.tone.check();
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
    stats["integrator"] = options.integrator;
    stats["size"] = {size.x, size.y};
    stats.update(rendering.stats);
    stats["scene"] = reportStructure(scene, structure);
    if (rendering.rectilinear) {
        stats["scene"]["rectilinear"] = *rendering.rectilinear;
    }
    return stats;
}

Rendering tracePaths(const RenderJob& job, const RenderOptions& options) {
    const PathChoice path = options.path.parse(options.integrator);
    const LitScene lit = lightScene(job.scene, options.scenePath, path, options.light.parse());
    for (const std::string& warning : lit.warnings) {
        printWarning(warning);
    }
    return renderPaths(job, lit.shading, path.applied(lit.shading.settings), options.path.samples());
}

void runRender(const RenderOptions& options) {
    checkArguments(options);
    const glm::uvec2 size = parseSize("--size", options.size);
    const AccelerationOptions structureOptions = options.structure.parse();
    checkWritable(options.outputPath);
    if (!options.statsPath.empty()) {
        const OutputFile probe(options.statsPath);
        if (sameFile(options.statsPath, options.outputPath)) {
            throw Error(ErrorKind::invalidArgument, "--stats and --output name the same file");
        }
    }

    const std::string traversal =
        options.traversal.empty() ? std::string(marchThrough(structureOptions.table)) : options.traversal;
    requireTable(structureOptions.table, traversal);

    // Before the long work, what can go wrong without it.
    std::optional<vulkan::Context> context;
    std::optional<vulkan::Device> device;
    if (options.backend == "gpu") {
        context.emplace();
        device.emplace(*context, options.device);
        render::requireTraversal(device->report(), traversal);
    }

    const Stopwatch import;
    const Scene scene = loadScene(options.scenePath, options.scene.parse());
    const double importSeconds = import.seconds();
    printWarnings(scene);
    const SceneCamera sceneCamera = options.camera.choose(scene, size);
    const Camera camera = makeCamera(sceneCamera, size.x, size.y, options.camera.parse());
    const Stopwatch build;
    const AccelerationStructure structure = buildAccelerationStructure(scene, structureOptions);
    const double buildSeconds = build.seconds();
    printWarnings(scene, structure);
    const RenderJob job{scene, structure, camera, device ? &*device : nullptr, traversal, options.quiet};
    Rendering rendering = options.integrator == "primary" ? renderPrimary(job) : tracePaths(job, options);

    rendering.stats["seconds"]["import"] = importSeconds;
    rendering.stats["seconds"]["build"] = buildSeconds;

    if (options.integrator != "primary" && std::filesystem::path(options.outputPath).extension() == ".png") {
        makeOpaque(rendering.image);
    }
    addHeader(rendering.image,
              {programVersion(), rendering.device, rendering.driver, rendering.traversal, options.integrator,
               options.scenePath, rendering.stats["seconds"]["render"].get<double>(), sceneCamera.name,
               sceneCamera.eye, sceneCamera.forward, sceneCamera.up});
    const nlohmann::ordered_json stats = makeStats(scene, structure, rendering, options, size);
    writeImage(rendering.image, options.outputPath, options.tone.parse(options.integrator));
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

void addRenderCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Render a scene to an EXR or PNG picture");
    const auto options = std::make_shared<RenderOptions>();
    command->add_option("SCENE", options->scenePath, "glTF, GLB, OBJ, PLY, OFF or STL file")->required();
    command->add_option("-o,--output", options->outputPath, "Picture to write: .exr (all channels) or .png")
        ->required();
    command->add_option("--size", options->size, "Width and height in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command->add_option("--stats", options->statsPath, "Write what it took as JSON")->type_name("FILE.json");
    command->add_flag("--quiet", options->quiet, "Print nothing but errors and warnings");

    options->camera.addTo(*command);
    options->tone.addTo(*command);

    const std::string deviceGroup = "Device";
    command
        ->add_option("--backend", options->backend, "gpu: Vulkan compute; cpu: the reference, a kd-tree walk")
        ->check(CLI::IsMember({"gpu", "cpu"}))
        ->capture_default_str()
        ->group(deviceGroup);
    command->add_option("--device", options->device, "Vulkan device, see `metamarch devices`")
        ->type_name("INDEX|NAME")
        ->group(deviceGroup);
    const std::span<const std::string_view> names = traversals();
    command
        ->add_option(
            "--traversal", options->traversal,
            fmt::format("How rays find triangles (default {}, or what marches --table)", names.front()))
        ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
        ->group(deviceGroup);
    command
        ->add_option(
            "--integrator", options->integrator,
            "path: global illumination; direct: without bounces; ao: white, under a white sky; primary: "
            "what is seen, lit from the eye, at pixel centres")
        ->check(CLI::IsMember({"path", "direct", "ao", "primary"}))
        ->capture_default_str()
        ->group(deviceGroup);
    options->path.addTo(*command);
    options->light.addTo(*command);
    options->scene.addTo(*command);
    options->structure.addTo(*command);
    command->footer(
        "Pixel (0,0) is top left.\n\n"
        "Example:\n  build/metamarch render scenes/objects.glb -o build/objects.exr --size 640x360 --spp 16");
    command->callback([options] { runRender(*options); });
}

} // namespace metamarch::cli
