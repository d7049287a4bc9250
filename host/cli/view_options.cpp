#include "metamarch/cli/view_options.h"

#include "metamarch/cli/number_list.h"
#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace metamarch::cli {

void ViewOptions::addTo(CLI::App& command) {
    const std::string group = "Camera (default: the scene's first, else the whole scene is framed)";
    const auto addText = [&](const char* name, std::string& value, const char* help, const char* type) {
        command.add_option(name, value, help)->type_name(type)->group(group);
    };
    addText("--camera", camera, "A camera of the scene", "NAME|INDEX");
    addText("--eye", eye, "Look from here", "x,y,z");
    addText("--target", target, "to there", "x,y,z");
    addText("--up", up, "with this direction upwards (default 0,1,0)", "x,y,z");
    command.add_option("--vfov", verticalFov, "Vertical field of view, of a perspective camera")
        ->type_name("DEG")
        ->group(group);
    command
        .add_option("--orthographic", verticalExtent,
                    "Parallel rays, in a picture this high in world units; with --eye and --target")
        ->type_name("HEIGHT")
        ->group(group);
    command.add_option("--aperture", aperture, "Radius of a thin lens, in world units (default: a pinhole)")
        ->type_name("R")
        ->group(group);
    command
        .add_option("--focus-distance", focusDistance,
                    "From the eye to the plane in focus, in world units (default: far away)")
        ->type_name("D")
        ->group(group);
    command.add_flag("--panorama", isPanorama, "All directions around the eye, equirectangular")
        ->group(group);
    command
        .add_option(
            "--filter", filter,
            "How samples of a pixel are spread: box, one pixel wide; tent, two; blackman-harris, three")
        ->check(CLI::IsMember({"box", "tent", "blackman-harris"}))
        ->capture_default_str()
        ->group(group);
}

void ViewOptions::check(const std::string& integrator) const {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    if (eye.empty() != target.empty()) {
        refuse("--eye and --target belong together");
    }
    if (!camera.empty() && !eye.empty()) {
        refuse("--camera and --eye exclude each other");
    }
    if (!up.empty() && eye.empty()) {
        refuse("--up needs --eye and --target");
    }
    if (verticalFov && !(*verticalFov > 0.0 && *verticalFov < 180.0)) {
        refuse(fmt::format("--vfov {}: give degrees between 0 and 180", *verticalFov));
    }
    if (verticalExtent && !(std::isfinite(*verticalExtent) && *verticalExtent > 0.0)) {
        refuse(fmt::format("--orthographic {}: give a finite height greater than 0", *verticalExtent));
    }
    if (verticalExtent && eye.empty()) {
        refuse("--orthographic needs --eye and --target");
    }
    if (verticalExtent && (verticalFov || isPanorama)) {
        refuse("--orthographic excludes --vfov and --panorama");
    }
    if (!(std::isfinite(aperture) && aperture >= 0.0)) {
        refuse(fmt::format("--aperture {}: give a finite radius of at least 0", aperture));
    }
    if (focusDistance && !(std::isfinite(*focusDistance) && *focusDistance > 0.0)) {
        refuse(fmt::format("--focus-distance {}: give a finite distance greater than 0", *focusDistance));
    }
    if (focusDistance && aperture == 0.0) {
        refuse("--focus-distance needs --aperture");
    }
    if (isPanorama && aperture > 0.0) {
        refuse("--panorama and --aperture exclude each other");
    }
    if (isPanorama && verticalFov) {
        refuse("--panorama and --vfov exclude each other");
    }
    if (integrator == "primary" && (aperture > 0.0 || filter != "box" || isPanorama)) {
        refuse("--aperture, --filter and --panorama are not for --integrator primary");
    }
}

SceneCamera ViewOptions::choose(const Scene& scene, const glm::uvec2 size) const {
    const auto fov = verticalFov ? std::optional(static_cast<float>(*verticalFov * std::numbers::pi / 180.0))
                                 : std::nullopt;
    SceneCamera chosen;
    if (const std::optional<Pose> given = pose()) {
        chosen = lookAt(given->eye, given->target, given->up);
        if (const std::optional<float> height = orthographicHeight()) {
            chosen.projection = SceneCamera::Projection::orthographic;
            chosen.verticalExtent = *height;
        }
    } else if (!camera.empty() || !scene.cameras.empty()) {
        chosen = selectCamera(scene, camera.empty() ? "0" : camera);
    } else {
        const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
        return frameBounds(boundsOf(scene), fov.value_or(kDefaultVerticalFov), aspect);
    }
    chosen.verticalFov = fov.value_or(chosen.verticalFov);
    return chosen;
}

std::optional<ViewOptions::Pose> ViewOptions::pose() const {
    if (eye.empty()) {
        return std::nullopt;
    }
    return Pose{parsePoint("--eye", eye), parsePoint("--target", target),
                parsePoint("--up", up.empty() ? "0,1,0" : up)};
}

CameraOptions ViewOptions::parse() const {
    CameraOptions options;
    options.pixelFilter = filter == "tent"  ? kFilterTent
                          : filter == "box" ? kFilterBox
                                            : kFilterBlackmanHarris;
    options.apertureRadius = static_cast<float>(aperture);
    if (focusDistance) {
        options.focusDistance = static_cast<float>(*focusDistance);
    }
    options.isPanorama = isPanorama;
    return options;
}

} // namespace metamarch::cli
