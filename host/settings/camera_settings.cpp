// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

#include <cmath>

namespace metamarch {
namespace {

constexpr std::pair<std::string_view, std::uint32_t> kPixelFilters[] = {
    {"box", kFilterBox}, {"tent", kFilterTent}, {"blackman-harris", kFilterBlackmanHarris}};

const NumberRange kPositive = {std::numeric_limits<float>::min(), std::numeric_limits<float>::max(),
                               "a finite length greater than 0"};

} // namespace

void declareCamera(SettingList& list, ViewChoice& view) {
    list.beginGroup("Camera (default: the scene's first, else the whole scene is framed)");
    list.text("camera", view.camera, "A camera of the scene").withValueName("NAME|INDEX").excludes({"eye"});
    list.point("eye", view.eye, "Look from this point").needs({"target"});
    list.point("target", view.target, "Look at this point").needs({"eye"});
    list.point("up", view.up, "This direction is up in the picture (default 0,1,0)").needs({"eye", "target"});
    list.number("vfov", view.verticalFov,
                {std::nextafter(0.0, 1.0), std::nextafter(180.0, 0.0), "degrees between 0 and 180"},
                "Vertical field of view, of a perspective camera")
        .withValueName("DEG")
        .excludes({"orthographic", "panorama"});
    list.number("orthographic", view.orthographicHeight, kPositive,
                "Parallel rays, in a picture this high in world units")
        .withValueName("HEIGHT")
        .needs({"eye", "target"})
        .excludes({"vfov", "panorama"});
    list.number("aperture", view.lens.apertureRadius,
                {0.0, std::numeric_limits<float>::max(), "a finite radius of at least 0"},
                "Radius of a thin lens, in world units; 0: a pinhole")
        .withValueName("R")
        .excludes({"panorama"});
    list.number("focus-distance", view.lens.focusDistance, kPositive,
                "From the eye to the plane in focus, in world units (default: far away)")
        .withValueName("D")
        .needs({"aperture"});
    list.flag("panorama", view.lens.isPanorama, "All directions around the eye, equirectangular");
    list.choice("filter", view.lens.pixelFilter, kPixelFilters,
                "How samples of a pixel are spread: box, one pixel wide; tent, two; blackman-harris, three");
}

void checkView(const ViewChoice& view, const Integrator integrator) {
    const CameraOptions& lens = view.lens;
    if (integrator == Integrator::primary &&
        (lens.apertureRadius > 0.0f || lens.pixelFilter != kFilterBox || lens.isPanorama)) {
        throw Error(
            ErrorKind::invalidArgument,
            "the rays of `primary` go from a pinhole through pixel centres: it has no aperture, filter "
            "or panorama",
            {"integrator", "aperture", "filter", "panorama"});
    }
}

} // namespace metamarch
