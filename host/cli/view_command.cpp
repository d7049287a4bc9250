// SPDX-License-Identifier: MIT
#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/picture_options.h"
#include "metamarch/cli/threads.h"
#include "metamarch/cli/version.h"
#include "metamarch/error/error.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/render/view_names.h"

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

struct ViewOptions : PictureOptions {
    ViewOptions() : PictureOptions(1024) {}

    std::string secondTraversal;
    std::string shown; // a name of render::kViewNames; empty: the picture
    std::string shaderFolder;
    bool hasNoPanels = false;
    bool hasTour = false;
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

// Returns the scene of the source tree that the program was built from.
std::filesystem::path tourScene() {
    std::error_code error;
    if (!std::filesystem::exists(METAMARCH_TOUR_SCENE, error)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--tour needs a SCENE: {} is not there", METAMARCH_TOUR_SCENE));
    }
    return METAMARCH_TOUR_SCENE;
}

void runView(const ViewOptions& options) {
    checkStructure(options.structure);
    std::error_code error;
    if (!options.shaderFolder.empty() && !std::filesystem::is_directory(options.shaderFolder, error)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--shaders {}: there is no such folder", options.shaderFolder));
    }
    viewer::ViewerOptions request;
    request.size = options.size;
    request.scene.file = options.scenePath;
    request.hasTour = options.hasTour;
    if (options.hasTour && options.scenePath.empty()) {
        request.scene.file = tourScene();
    }
    request.scene.structure = options.structure;
    viewer::Settings& settings = request.settings;
    settings.import = options.import;
    settings.light = options.light;
    settings.path = options.path;
    settings.samples = options.samplesPerPixel;
    settings.pixelFilter = options.view.lens.pixelFilter;
    settings.tone = options.tone;
    settings.hasPanels = !options.hasNoPanels && !options.hasTour;
    settings.traversal = options.traversal.empty()
                             ? std::string(render::marchingTraversal(request.scene.structure.table))
                             : options.traversal;
    settings.secondTraversal = options.secondTraversal;
    render::requireTable(request.scene.structure.table, settings.traversal);
    if (!options.shown.empty()) {
        settings.view = std::ranges::find(render::kViewNames, options.shown, &render::ViewName::name)->view;
    }
    request.chooseCamera = [&](const Scene& scene, const float aspect) {
        return chooseViewCamera(options.view, scene, aspect);
    };
    request.device = options.device;
    request.shaderFolder = options.shaderFolder.empty() ? METAMARCH_SHADER_FOLDER : options.shaderFolder;
    request.software = programVersion();
    viewer::runViewer(request);
}

#else

void runView(const ViewOptions&) {
    throw Error(ErrorKind::noDevice,
                "this build has no viewer: GLFW, Dear ImGui or glslang was missing when it was "
                "configured (Debian: libglfw3-dev libimgui-dev glslang-dev)");
}

#endif

} // namespace

Command makeViewCommand() {
    const auto options = std::make_shared<ViewOptions>();
    Command command{"view", "Look at a scene in a window", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings
        .positional("SCENE", options->scenePath,
                    "glTF, GLB, OBJ, PLY, OFF or STL file (default: an empty window, to drop one on)")
        .optional();
    settings.size("size", options->size, "Width and height of the window");
    settings.flag("no-panels", options->hasNoPanels, "Begin without panels (Tab shows them)");
    settings.flag("tour", options->hasTour,
                  "Explain in ten screens how rays find triangles (default SCENE: the shipped one)");
    declareCamera(settings, options->view);
    declareTone(settings, options->tone);
    settings.beginGroup("Device");
    declareDevice(settings, options->device);
    declareThreads(settings, options->threads);
    declareTraversal(settings, "traversal", options->traversal, "How rays find triangles");
    declareTraversal(settings, "split", options->secondTraversal,
                     "Another traversal on the right half of the window");
    declareIntegrator(settings, options->path, kFilmIntegrators);
    std::vector<std::string> views;
    views.reserve(render::kViewNames.size());
    for (const render::ViewName& known : render::kViewNames) {
        views.emplace_back(known.name);
    }
    settings.word("view", options->shown, std::move(views), "What the window shows in place of the picture");
    settings
        .text("shaders", options->shaderFolder,
              "Folder of shaders that is watched for changes (default: the one of the build)")
        .withValueName("DIR");
    declarePath(settings, options->path, options->samplesPerPixel);
    declareLight(settings, options->light);
    declareImport(settings, options->import);
    declareStructure(settings, options->structure);
    command.footer = "Keys are listed in the window.\n\nExample:\n  build/metamarch view scenes/objects.glb";
    command.run = [options](const SettingList& given) {
        chooseTone(given, options->path.integrator, options->tone);
        const Threads threads(options->threads);
        runView(*options);
    };
    return command;
}

} // namespace metamarch::cli
