// SPDX-License-Identifier: MIT
#include "metamarch/cli/view_command.h"

#include "metamarch/cli/commands.h"
#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/threads.h"
#include "metamarch/render/view_names.h"

#include <memory>
#include <string>
#include <vector>

namespace metamarch::cli {
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
    command.footer = "F1 lists the keys.\n\nExample:\n  build/metamarch view scenes/objects.glb";
    command.run = [options](const SettingList& given) {
        chooseTone(given, options->path.integrator, options->tone);
        runView(*options);
    };
    return command;
}

} // namespace metamarch::cli
