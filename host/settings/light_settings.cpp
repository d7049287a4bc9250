// SPDX-License-Identifier: MIT
#include "metamarch/settings/number_list.h"
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace metamarch {
namespace {

using Kind = LightChoice::Kind;

Setting::Access mapAccess(LightChoice& light) {
    return {[&light](const std::string& text) {
                light.kind = Kind::map;
                light.map = text;
            },
            [&light] { return light.kind == Kind::map ? light.map.string() : ""; }};
}

Setting::Access backgroundAccess(LightChoice& light) {
    return {[&light](const std::string& text) {
                const glm::dvec3 color = parsePoint(text);
                if (glm::any(glm::lessThan(color, glm::dvec3(0.0)))) {
                    throw Error(ErrorKind::invalidArgument, "give radiance of at least 0");
                }
                light.kind = Kind::background;
                light.background = glm::vec3(color);
            },
            [&light] {
                const glm::vec3 color = light.background;
                return light.kind == Kind::background ? fmt::format("{},{},{}", color.r, color.g, color.b)
                                                      : "";
            }};
}

Setting::Access skyAccess(LightChoice& light) {
    return {[&light](const std::string& text) { light.kind = text == "off" ? Kind::automatic : Kind::sky; },
            [&light] { return std::string(light.kind == Kind::sky ? "on" : "off"); }};
}

Setting::Access sunAccess(LightChoice& light) {
    return {[&light](const std::string& text) {
                const glm::dvec3 given = parsePoint(text);
                if (given == glm::dvec3(0.0)) {
                    throw Error(ErrorKind::invalidArgument, "give a direction, not 0,0,0");
                }
                const glm::dvec3 direction = glm::normalize(given);
                light.kind = Kind::sky;
                light.sunElevation = static_cast<float>(std::asin(direction.y));
                light.sunAzimuth = static_cast<float>(std::atan2(direction.z, direction.x));
            },
            [&light] {
                const LightChoice plain;
                const bool isMoved =
                    light.sunElevation != plain.sunElevation || light.sunAzimuth != plain.sunAzimuth;
                const float across = std::cos(light.sunElevation);
                return light.kind == Kind::sky && isMoved
                           ? fmt::format("{:.6g},{:.6g},{:.6g}", across * std::cos(light.sunAzimuth),
                                         std::sin(light.sunElevation), across * std::sin(light.sunAzimuth))
                           : "";
            }};
}

} // namespace

void declareLight(SettingList& list, LightChoice& light) {
    list.beginGroup("Light (default: the scene's; a clear sky where it has none)");
    list.add("env", Setting::Kind::value, mapAccess(light),
             "Equirectangular map, HDR or EXR, that lights the scene from all around and is its background")
        .takes("FILE")
        .excludes({"background", "sky", "sun"});
    list.angle("env-rotation", light.rotation, {.wanted = "finite degrees"},
               "Turn the map around y, from +z towards +x")
        .slides({-180.0, 180.0, "%.0f deg"});
    list.number("env-intensity", light.intensity,
                {0.0, std::numeric_limits<float>::max(), "a finite number of at least 0"},
                "Multiply the radiance of map or sky")
        .takes("F")
        .slides({0.01, 100.0, "%.2f", true});
    list.add("background", Setting::Kind::value, backgroundAccess(light), "The same radiance from everywhere")
        .takes("r,g,b")
        .excludes({"env", "sky", "sun"});
    list.add("sky", Setting::Kind::flag, skyAccess(light), "A clear sky with its sun")
        .excludes({"env", "background"});
    list.add("sun", Setting::Kind::value, sunAccess(light),
             "Where the sun stands, as a direction (default 45 degrees above +x)")
        .takes("x,y,z")
        .excludes({"env", "background"});
}

} // namespace metamarch
