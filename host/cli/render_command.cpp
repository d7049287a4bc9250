#include "cli/render_command.h"

#include "cli/number_list.h"
#include "cli/progress.h"
#include "cli/scene_options.h"
#include "cli/structure_options.h"
#include "cli/structure_report.h"
#include "cli/version.h"
#include "cli/warnings.h"
#include "error.h"
#include "image/image_file.h"
#include "image/output_file.h"
#include "image/primary_image.h"
#include "reference/primary.h"
#include "render/primary_renderer.h"
#include "scene/import.h"
#include "scene/view.h"
#include "shader_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

namespace metamarch::cli {
namespace {

struct RenderOptions {
    std::string scenePath;
    std::string outputPath;
    std::string size = "1280x720";
    std::string camera;
    std::string eye;
    std::string target;
    std::string up;
    std::optional<double> verticalFov; // degrees
    std::string backend = "gpu";
    std::string device;
    std::string traversal;
    std::string integrator = "primary";
    SceneOptions scene;
    StructureOptions structure;
    std::string statsPath;
    bool quiet = false;
};

// What rendered, for the header, the statistics and the user.
struct Rendering {
    std::vector<PrimaryPixel> pixels;
    std::string device;
    std::string driver;
    std::string traversal;
    nlohmann::ordered_json seconds;
};

void checkArguments(const RenderOptions& options) {
    const auto refuse = [](const std::string& line) { throw Error(ExitCode::badArguments, line); };
    if (options.eye.empty() != options.target.empty()) {
        refuse("--eye and --target belong together");
    }
    if (!options.camera.empty() && !options.eye.empty()) {
        refuse("--camera and --eye exclude each other");
    }
    if (!options.up.empty() && options.eye.empty()) {
        refuse("--up needs --eye and --target");
    }
    if (options.verticalFov && !(*options.verticalFov > 0.0 && *options.verticalFov < 180.0)) {
        refuse(fmt::format("--vfov {}: give degrees between 0 and 180", *options.verticalFov));
    }
    if (options.backend == "cpu" && !(options.device.empty() && options.traversal.empty())) {
        refuse("--backend cpu walks the kd-tree with a stack on the processor; --device and --traversal are "
               "for the gpu");
    }
}

SceneCamera chooseCamera(const RenderOptions& options, const Scene& scene, const glm::uvec2 size) {
    const auto verticalFov =
        options.verticalFov
            ? std::optional(static_cast<float>(*options.verticalFov * std::numbers::pi / 180.0))
            : std::nullopt;
    SceneCamera camera;
    if (!options.eye.empty()) {
        const std::string up = options.up.empty() ? "0,1,0" : options.up;
        camera = lookAt(parsePoint("--eye", options.eye), parsePoint("--target", options.target),
                        parsePoint("--up", up));
    } else if (!options.camera.empty() || !scene.cameras.empty()) {
        camera = selectCamera(scene, options.camera.empty() ? "0" : options.camera);
    } else {
        const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
        return frameBounds(boundsOf(scene), verticalFov.value_or(kDefaultVerticalFov), aspect);
    }
    camera.verticalFov = verticalFov.value_or(camera.verticalFov);
    return camera;
}

bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    return weakly_canonical(absolute(a)) == weakly_canonical(absolute(b));
}

double secondsSince(const std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Rendering renderOnCpu(const AccelerationStructure& structure, const ShadingData& shading,
                      const Camera& camera, const bool quiet) {
    Progress progress("rendering", !quiet);
    std::atomic<unsigned> rows = 0;
    const auto start = std::chrono::steady_clock::now();
    Rendering result;
    result.pixels = metamarch::renderPrimary(structure, shading.materials, shading.materialOfTriangle, camera,
                                             [&](const unsigned finished) { rows += finished; });
    result.device = "cpu";
    result.driver = "metamarch";
    result.traversal = "kd_stack";
    result.seconds["render"] = secondsSince(start);
    return result;
}

Rendering renderOnGpu(const vulkan::Device& device, const AccelerationStructure& structure,
                      const ShadingData& shading, const std::string& traversal, const Camera& camera,
                      const bool quiet) {
    Rendering result;
    auto start = std::chrono::steady_clock::now();
    const render::SceneBuffers scene(device, structure, shading);
    result.seconds["upload"] = secondsSince(start);

    start = std::chrono::steady_clock::now();
    auto progress = std::make_unique<Progress>("compiling", !quiet);
    bool first = true;
    render::PrimaryRender render =
        render::renderPrimary(device, scene, traversal, camera, [&](const double part) {
            if (first) {
                progress = nullptr;
                progress = std::make_unique<Progress>("rendering", !quiet);
                first = false;
            }
            progress->show(part);
        });
    result.seconds["render"] = secondsSince(start);
    result.seconds["firstSubmission"] = render.firstSeconds;
    result.seconds["device"] = render.deviceSeconds;
    result.pixels = std::move(render.pixels);
    result.device = device.name();
    result.driver = device.report().driverInfo;
    result.traversal = traversal;
    return result;
}

void addHeader(Image& image, const RenderOptions& options, const SceneCamera& camera,
               const Rendering& rendering) {
    const auto point = [](const glm::vec3 v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    image.attributes = {{"Software", programVersion()},
                        {"metamarch/device", rendering.device},
                        {"metamarch/driver", rendering.driver},
                        {"metamarch/traversal", rendering.traversal},
                        {"metamarch/integrator", options.integrator},
                        {"metamarch/scene", options.scenePath},
                        {"metamarch/camera", camera.name},
                        {"metamarch/eye", point(camera.eye)},
                        {"metamarch/forward", point(camera.forward)},
                        {"metamarch/up", point(camera.up)}};
}

nlohmann::ordered_json makeStats(const Scene& scene, const AccelerationStructure& structure,
                                 const Rendering& rendering, const glm::uvec2 size) {
    double steps = 0.0;
    double tests = 0.0;
    std::uint64_t hits = 0;
    for (const PrimaryPixel& pixel : rendering.pixels) {
        steps += pixel.steps;
        tests += pixel.tests;
        hits += pixel.triangleId != kNoTriangle ? 1 : 0;
    }
    const auto rays = static_cast<double>(rendering.pixels.size());
    nlohmann::ordered_json stats;
    stats["schema"] = 1;
    stats["device"] = rendering.device;
    stats["driver"] = rendering.driver;
    stats["traversal"] = rendering.traversal;
    stats["size"] = {size.x, size.y};
    stats["rays"] = rendering.pixels.size();
    stats["hits"] = hits;
    stats["stepsPerRay"] = steps / rays;
    stats["testsPerRay"] = tests / rays;
    stats["mraysPerSecond"] = rays / rendering.seconds["render"].get<double>() * 1e-6;
    stats["seconds"] = rendering.seconds;
    stats["scene"] = reportStructure(scene, structure);
    return stats;
}

void runRender(const RenderOptions& options) {
    checkArguments(options);
    const glm::uvec2 size = parseSize("--size", options.size);
    const AccelerationOptions structureOptions = options.structure.parse();
    checkWritable(options.outputPath);
    if (!options.statsPath.empty()) {
        const OutputFile probe(options.statsPath);
        if (sameFile(options.statsPath, options.outputPath)) {
            throw Error(ExitCode::badArguments, "--stats and --output name the same file");
        }
    }

    const std::string traversal =
        options.traversal.empty() ? std::string(traversals().front()) : options.traversal;

    // Before the long work, what can go wrong without it.
    std::optional<vulkan::Context> context;
    std::optional<vulkan::Device> device;
    if (options.backend == "gpu") {
        context.emplace();
        device.emplace(*context, options.device);
        render::requireTraversal(device->report(), traversal);
    }

    const Scene scene = loadScene(options.scenePath, options.scene.parse());
    printWarnings(scene);
    const SceneCamera sceneCamera = chooseCamera(options, scene, size);
    const Camera camera = makeCamera(sceneCamera, size.x, size.y);
    const AccelerationStructure structure = buildAccelerationStructure(scene, structureOptions);
    printWarnings(scene, structure);
    const ShadingData shading = makeShadingData(scene);
    const Rendering rendering =
        device ? renderOnGpu(*device, structure, shading, traversal, camera, options.quiet)
               : renderOnCpu(structure, shading, camera, options.quiet);

    Image image = primaryImage(rendering.pixels, static_cast<int>(size.x), static_cast<int>(size.y));
    addHeader(image, options, sceneCamera, rendering);
    const nlohmann::ordered_json stats = makeStats(scene, structure, rendering, size);
    writeImage(image, options.outputPath);
    if (!options.statsPath.empty()) {
        // A driver may call its device by bytes that are no UTF-8.
        writeText(options.statsPath,
                  stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    }
    if (!options.quiet) {
        fmt::print(
            "{}: {} x {}, {} triangles, {} on {} ({}), {:.2f} s, {:.2f} steps and {:.2f} tests per ray\n",
            options.outputPath, size.x, size.y, scene.triangles.size(), rendering.traversal, rendering.device,
            rendering.driver, rendering.seconds["render"].get<double>(), stats["stepsPerRay"].get<double>(),
            stats["testsPerRay"].get<double>());
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

    const std::string cameraGroup = "Camera (default: the scene's first, else the whole scene is framed)";
    const auto addCameraOption = [&](const char* name, std::string& value, const char* help,
                                     const char* type) {
        command->add_option(name, value, help)->type_name(type)->group(cameraGroup);
    };
    addCameraOption("--camera", options->camera, "A camera of the scene", "NAME|INDEX");
    addCameraOption("--eye", options->eye, "Look from here", "x,y,z");
    addCameraOption("--target", options->target, "to there", "x,y,z");
    addCameraOption("--up", options->up, "with this direction upwards (default 0,1,0)", "x,y,z");
    command->add_option("--vfov", options->verticalFov, "Vertical field of view, of a perspective camera")
        ->type_name("DEG")
        ->group(cameraGroup);

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
        ->add_option("--traversal", options->traversal,
                     fmt::format("How rays find triangles (default {})", names.front()))
        ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
        ->group(deviceGroup);
    command->add_option("--integrator", options->integrator, "What a pixel shows")
        ->check(CLI::IsMember({"primary"}))
        ->capture_default_str()
        ->group(deviceGroup);
    options->scene.addTo(*command);
    options->structure.addTo(*command);
    command->footer(
        "Pixel (0,0) is top left; rays go through pixel centres.\n\n"
        "Example:\n  build/metamarch render scenes/objects.glb -o build/objects.exr --size 640x360");
    command->callback([options] { runRender(*options); });
}

} // namespace metamarch::cli
