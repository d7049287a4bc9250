#include "metamarch/cli/view_command.h"

#include "metamarch/cli/light_options.h"
#include "metamarch/cli/number_list.h"
#include "metamarch/cli/path_options.h"
#include "metamarch/cli/scene_options.h"
#include "metamarch/cli/structure_options.h"
#include "metamarch/cli/tone_options.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/view_options.h"
#include "metamarch/error/error.h"
#include "metamarch/render/view_names.h"
#include "metamarch/shaders/shader_library.h"

#ifdef METAMARCH_HAS_VIEWER
#include "metamarch/viewer/actions.h"
#include "metamarch/viewer/viewer.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace metamarch::cli {
namespace {

struct ViewerArguments {
    std::string scenePath;
    std::string size = "1280x720";
    ViewOptions camera;
    ToneOptions tone;
    std::string device;
    std::string traversal;
    std::string rival;
    std::string integrator = "path";
    std::string view;
    PathOptions path{1024};
    LightOptions light;
    SceneOptions scene;
    StructureOptions structure;
    std::string shaderFolder;
    bool hasNoPanels = false;
};

#ifdef METAMARCH_HAS_VIEWER

viewer::ViewCamera poseOf(const ViewOptions::Pose& pose, const ViewOptions& options) {
    viewer::ViewCamera camera;
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    camera.verticalExtent = options.orthographicHeight();
    lookAt(camera.eye, camera.target, camera.up); // refuses a view without direction
    return camera;
}

viewer::ViewCamera chooseCamera(const ViewOptions& options, const Scene& scene, const float aspect) {
    viewer::ViewCamera camera;
    const std::optional<double> fov = options.verticalFovDegrees();
    if (const std::optional<ViewOptions::Pose> pose = options.pose()) {
        camera = poseOf(*pose, options);
    } else if (!options.cameraSelection().empty() || !scene.cameras.empty()) {
        const std::string& wanted = options.cameraSelection();
        const SceneCamera& chosen = selectCamera(scene, wanted.empty() ? "0" : wanted);
        camera = viewer::ofFile(scene, static_cast<std::size_t>(&chosen - scene.cameras.data()),
                                viewer::distanceTo(boundsOf(scene), chosen.eye));
    } else {
        camera = viewer::framing(boundsOf(scene), aspect, fov.value_or(camera.verticalFov));
    }
    camera.verticalFov = fov.value_or(camera.verticalFov);
    const CameraOptions lens = options.parse();
    camera.apertureRadius = lens.apertureRadius;
    camera.isPanorama = lens.isPanorama;
    if (std::isfinite(lens.focusDistance)) {
        camera.focusDistance = lens.focusDistance;
    }
    return camera;
}

void runView(const ViewerArguments& arguments) {
    arguments.camera.check(arguments.integrator);
    arguments.path.check();
    arguments.light.check();
    arguments.tone.check();
    std::error_code error;
    if (!arguments.shaderFolder.empty() && !std::filesystem::is_directory(arguments.shaderFolder, error)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--shaders {}: there is no such folder", arguments.shaderFolder));
    }
    viewer::ViewerOptions options;
    options.size = parseSize("--size", arguments.size);
    options.scene.file = arguments.scenePath;
    options.scene.structure = arguments.structure.parse();
    viewer::Settings& settings = options.settings;
    settings.import = arguments.scene.parse();
    settings.light = arguments.light.parse();
    settings.path = arguments.path.parse(arguments.integrator);
    settings.samples = arguments.path.samples();
    settings.tone = arguments.tone.parse(arguments.integrator);
    settings.hasPanels = !arguments.hasNoPanels;
    settings.traversal = arguments.traversal.empty()
                             ? std::string(marchThrough(options.scene.structure.table))
                             : arguments.traversal;
    settings.rival = arguments.rival;
    requireTable(options.scene.structure.table, settings.traversal);
    if (!arguments.view.empty()) {
        settings.view = std::ranges::find(render::kViewNames, arguments.view, &render::ViewName::name)->view;
    }
    options.chooseCamera = [&](const Scene& scene, const float aspect) {
        return chooseCamera(arguments.camera, scene, aspect);
    };
    options.device = arguments.device;
    options.shaderFolder = arguments.shaderFolder.empty() ? METAMARCH_SHADER_FOLDER : arguments.shaderFolder;
    options.software = programVersion();
    viewer::runViewer(options);
}

#else

void runView(const ViewerArguments&) {
    throw Error(ErrorKind::noDevice,
                "this build has no viewer: GLFW, Dear ImGui or glslang was missing when it was "
                "configured (Debian: libglfw3-dev libimgui-dev glslang-dev)");
}

#endif

} // namespace

void addViewCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("view", "Look at a scene in a window");
    const auto arguments = std::make_shared<ViewerArguments>();
    command->add_option("SCENE", arguments->scenePath, "glTF, GLB, OBJ, PLY, OFF or STL file")->required();
    command->add_option("--size", arguments->size, "Width and height of the window")
        ->type_name("WxH")
        ->capture_default_str();
    command->add_flag("--no-panels", arguments->hasNoPanels, "Begin without panels (Tab shows them)");
    arguments->camera.addTo(*command);
    arguments->tone.addTo(*command);

    const std::string group = "Device";
    command->add_option("--device", arguments->device, "Vulkan device, see `metamarch devices`")
        ->type_name("INDEX|NAME")
        ->group(group);
    const std::vector<std::string> names(traversals().begin(), traversals().end());
    command->add_option("--traversal", arguments->traversal, "How rays find triangles")
        ->check(CLI::IsMember(names))
        ->group(group);
    command->add_option("--split", arguments->rival, "Another traversal on the right half of the window")
        ->check(CLI::IsMember(names))
        ->group(group);
    command->add_option("--integrator", arguments->integrator, "As for `metamarch render`")
        ->check(CLI::IsMember({"path", "direct", "ao"}))
        ->capture_default_str()
        ->group(group);
    std::vector<std::string> views;
    for (const render::ViewName& known : render::kViewNames) {
        views.emplace_back(known.name);
    }
    command->add_option("--view", arguments->view, "What the window shows in place of the picture")
        ->check(CLI::IsMember(views))
        ->group(group);
    command
        ->add_option("--shaders", arguments->shaderFolder,
                     "Folder of shaders that is watched for changes (default: the one of the build)")
        ->type_name("DIR")
        ->group(group);
    arguments->path.addTo(*command);
    arguments->light.addTo(*command);
    arguments->scene.addTo(*command);
    arguments->structure.addTo(*command);
    command->footer("Keys are listed in the window.\n\nExample:\n  build/metamarch view scenes/objects.glb");
    command->callback([arguments] { runView(*arguments); });
}

} // namespace metamarch::cli
