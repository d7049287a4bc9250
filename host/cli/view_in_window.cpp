// SPDX-License-Identifier: MIT
#include "metamarch/cli/threads.h"
#include "metamarch/cli/version.h"
#include "metamarch/cli/view_command.h"
#include "metamarch/error/error.h"
#include "metamarch/render/traversal_choice.h"
#include "metamarch/render/view_names.h"
#include "metamarch/viewer/actions.h"
#include "metamarch/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

namespace metamarch::cli {
namespace {

viewer::ViewCamera poseOf(const ViewChoice& view) {
    viewer::ViewCamera camera;
    camera.eye = *view.eye;
    camera.target = *view.target;
    camera.up = view.up.value_or(camera.up);
    camera.verticalExtent = view.orthographicHeight;
    lookAt(camera.eye, camera.target, camera.up); // refuses a view without direction
    return camera;
}

viewer::ViewCamera chooseViewCamera(const ViewChoice& view, const Scene& scene,
                                    const viewer::ViewerOptions::FrameAll& frameAll) {
    viewer::ViewCamera camera;
    if (view.eye && view.target) {
        camera = poseOf(view);
    } else if (!view.camera.empty() || !scene.cameras.empty()) {
        const std::string name = view.camera.empty() ? "0" : view.camera;
        const SceneCamera& chosen = selectCamera(scene, name);
        camera = viewer::ofFile(scene, static_cast<std::size_t>(&chosen - scene.cameras.data()),
                                viewer::distanceTo(boundsOf(scene), chosen.eye));
    } else {
        camera = frameAll(view.verticalFov.value_or(camera.verticalFov));
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

} // namespace

void runView(const ViewOptions& options) {
    const Threads threads(options.threads);
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
    request.chooseCamera = [&](const Scene& scene, const viewer::ViewerOptions::FrameAll& frameAll) {
        return chooseViewCamera(options.view, scene, frameAll);
    };
    request.device = options.device;
    request.shaderFolder = options.shaderFolder.empty() ? METAMARCH_SHADER_FOLDER : options.shaderFolder;
    request.software = programVersion();
    viewer::runViewer(request);
}

} // namespace metamarch::cli
