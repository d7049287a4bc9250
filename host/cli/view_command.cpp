// SPDX-License-Identifier: MIT
#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/version.h"
#include "metamarch/error/error.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/render/view_names.h"
#include "metamarch/settings/render_settings.h"

#ifdef METAMARCH_HAS_VIEWER
#include "metamarch/viewer/actions.h"
#include "metamarch/viewer/viewer.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace metamarch::cli {
namespace {

struct ViewerArguments {
    std::string scenePath;
    glm::uvec2 size{1280, 720};
    ViewChoice view;
    ToneMapping tone{kToneNeutral};
    std::string device;
    std::string traversal;
    std::string secondTraversal;
    std::string shown; // a name of render::kViewNames; empty: the picture
    PathChoice path;
    std::uint32_t samplesPerPixel = 1024;
    LightChoice light;
    ImportOptions import;
    AccelerationOptions structure;
    std::string shaderFolder;
    std::optional<std::uint32_t> threads;
    bool hasNoPanels = false;
};

#ifdef METAMARCH_HAS_VIEWER

viewer::ViewCamera poseOf(const ViewChoice& view) {
    viewer::ViewCamera camera;
    camera.eye = *view.eye;
    camera.target = *view.target;
    camera.up = view.up.value_or(camera.up);
    camera.verticalExtent = view.orthographicHeight;
    lookAt(camera.eye, camera.target, camera.up); // refuses a view without direction
    return camera;
}

viewer::ViewCamera chooseViewCamera(const ViewChoice& view, const Scene& scene, const float aspect) {
    viewer::ViewCamera camera;
    if (view.eye && view.target) {
        camera = poseOf(view);
    } else if (!view.camera.empty() || !scene.cameras.empty()) {
        const SceneCamera& chosen = selectCamera(scene, view.camera.empty() ? "0" : view.camera);
        camera = viewer::ofFile(scene, static_cast<std::size_t>(&chosen - scene.cameras.data()),
                                viewer::distanceTo(boundsOf(scene), chosen.eye));
    } else {
        camera = viewer::framing(boundsOf(scene), aspect, view.verticalFov.value_or(camera.verticalFov));
    }
    camera.verticalFov = view.verticalFov.value_or(camera.verticalFov);
    camera.apertureRadius = view.lens.apertureRadius;
    camera.isPanorama = view.lens.isPanorama;
    if (std::isfinite(view.lens.focusDistance)) {
        camera.focusDistance = view.lens.focusDistance;
    }
    return camera;
}

void runView(const ViewerArguments& arguments) {
    checkStructure(arguments.structure);
    std::error_code error;
    if (!arguments.shaderFolder.empty() && !std::filesystem::is_directory(arguments.shaderFolder, error)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--shaders {}: there is no such folder", arguments.shaderFolder));
    }
    viewer::ViewerOptions options;
    options.size = arguments.size;
    options.scene.file = arguments.scenePath;
    options.scene.structure = arguments.structure;
    viewer::Settings& settings = options.settings;
    settings.import = arguments.import;
    settings.light = arguments.light;
    settings.path = arguments.path;
    settings.samples = arguments.samplesPerPixel;
    settings.pixelFilter = arguments.view.lens.pixelFilter;
    settings.tone = arguments.tone;
    settings.hasPanels = !arguments.hasNoPanels;
    settings.traversal = arguments.traversal.empty()
                             ? std::string(render::marchingTraversal(options.scene.structure.table))
                             : arguments.traversal;
    settings.secondTraversal = arguments.secondTraversal;
    render::requireTable(options.scene.structure.table, settings.traversal);
    if (!arguments.shown.empty()) {
        settings.view = std::ranges::find(render::kViewNames, arguments.shown, &render::ViewName::name)->view;
    }
    options.chooseCamera = [&](const Scene& scene, const float aspect) {
        return chooseViewCamera(arguments.view, scene, aspect);
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

Command makeViewCommand() {
    const auto arguments = std::make_shared<ViewerArguments>();
    Command command{"view", "Look at a scene in a window", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positional("SCENE", arguments->scenePath, "glTF, GLB, OBJ, PLY, OFF or STL file");
    settings.size("size", arguments->size, "Width and height of the window");
    settings.flag("no-panels", arguments->hasNoPanels, "Begin without panels (Tab shows them)");
    declareCamera(settings, arguments->view);
    declareTone(settings, arguments->tone);
    settings.beginGroup("Device");
    declareDevice(settings, arguments->device);
    declareThreads(settings, arguments->threads);
    declareTraversal(settings, "traversal", arguments->traversal, "How rays find triangles");
    declareTraversal(settings, "split", arguments->secondTraversal,
                     "Another traversal on the right half of the window");
    declareIntegrator(settings, arguments->path, kFilmIntegrators);
    std::vector<std::string> views;
    for (const render::ViewName& known : render::kViewNames) {
        views.emplace_back(known.name);
    }
    settings.word("view", arguments->shown, std::move(views),
                  "What the window shows in place of the picture");
    settings
        .text("shaders", arguments->shaderFolder,
              "Folder of shaders that is watched for changes (default: the one of the build)")
        .withValueName("DIR");
    declarePath(settings, arguments->path, arguments->samplesPerPixel);
    declareLight(settings, arguments->light);
    declareImport(settings, arguments->import);
    declareStructure(settings, arguments->structure);
    command.footer = "Keys are listed in the window.\n\nExample:\n  build/metamarch view scenes/objects.glb";
    command.run = [arguments](const SettingList& given) {
        chooseTone(given, arguments->path.integrator, arguments->tone);
        const Threads threads(arguments->threads);
        runView(*arguments);
    };
    return command;
}

} // namespace metamarch::cli
