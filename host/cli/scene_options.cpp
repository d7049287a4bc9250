#include "metamarch/cli/scene_options.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <cmath>

namespace metamarch::cli {

void SceneOptions::addTo(CLI::App& command) {
    const std::string group = "Scene";
    command.add_option("--scale", scale, "Multiply the scene by S")->type_name("S")->group(group);
    command.add_option("--variant", options.variant, "Material variant (default: the file's own materials)")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_option("--time", options.time, "Pose the animations at this time (default: as the file stands)")
        ->type_name("SECONDS")
        ->group(group);
    command.add_option("--animation", options.animation, "Pose by this animation alone (default: by all)")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_flag("--allow-missing-textures", options.allowMissingTextures,
                  "Warn of textures that cannot be read and go on without them")
        ->group(group);
}

ImportOptions SceneOptions::parse() const {
    ImportOptions parsed = options;
    parsed.scale = static_cast<float>(scale);
    if (!std::isfinite(parsed.scale) || parsed.scale == 0.0f) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--scale {}: give a finite number other than 0", scale));
    }
    if (parsed.time && !std::isfinite(*parsed.time)) {
        throw Error(ErrorKind::invalidArgument, fmt::format("--time {}: give finite seconds", *parsed.time));
    }
    if (!parsed.animation.empty() && !parsed.time) {
        throw Error(ErrorKind::invalidArgument, "--animation needs --time");
    }
    return parsed;
}

} // namespace metamarch::cli
