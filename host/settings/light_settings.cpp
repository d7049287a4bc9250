// SPDX-License-Identifier: MIT
#include "metamarch/settings/number_text.h"
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

// The direction of the sun in radians.
struct SunAngles {
    float elevation;
    float azimuth;

    bool operator==(const SunAngles&) const = default;
};

SunAngles anglesOf(const std::string& text) {
    const glm::dvec3 given = parsePoint(text);
    if (given == glm::dvec3(0.0)) {
        throw Error(ErrorKind::invalidArgument, "give a direction, not 0,0,0");
    }
    // The float nearest to pi / 2 is greater than pi / 2, and would put a sun at the zenith onto the other
    // side.
    const float zenith = std::nextafter(std::numbers::pi_v<float> / 2.0f, 0.0f);
    const auto elevation = static_cast<float>(std::atan2(given.y, std::hypot(given.x, given.z)));
    return {std::clamp(elevation, -zenith, zenith), static_cast<float>(std::atan2(given.z, given.x))};
}

std::string directionText(const SunAngles& sun) {
    const double elevation = sun.elevation;
    const double azimuth = sun.azimuth;
    return shortestText(
        [&](const int digits) {
            const double across = std::cos(elevation);
            return fmt::format("{:.{}g},{:.{}g},{:.{}g}", across * std::cos(azimuth), digits,
                               std::sin(elevation), digits, across * std::sin(azimuth), digits);
        },
        [&](const std::string& text) { return anglesOf(text) == sun; });
}

Setting::Access sunAccess(LightChoice& light) {
    return {[&light](const std::string& text) {
                const SunAngles sun = anglesOf(text);
                light.kind = Kind::sky;
                light.sunElevation = sun.elevation;
                light.sunAzimuth = sun.azimuth;
            },
            [&light] {
                const LightChoice plain;
                const SunAngles sun{light.sunElevation, light.sunAzimuth};
                const bool isMoved = sun != SunAngles{plain.sunElevation, plain.sunAzimuth};
                return light.kind == Kind::sky && isMoved ? directionText(sun) : "";
            }};
}

} // namespace

void declareLight(SettingList& list, LightChoice& light) {
    list.beginGroup("Light (default: the scene's; a clear sky where it has none)");
    list.add("env", Setting::Kind::value, mapAccess(light),
             "Equirectangular map, HDR or EXR, that lights the scene from all around and is its background")
        .withValueName("FILE")
        .excludes({"background", "sky", "sun"});
    list.angle("env-rotation", light.rotation, {.wanted = "finite degrees"},
               "Turn the map around y, from +z towards +x")
        .slides({-180.0, 180.0, "%.0f deg"});
    list.number("env-intensity", light.intensity,
                {0.0, std::numeric_limits<float>::max(), "a finite number of at least 0"},
                "Multiply the radiance of map or sky")
        .withValueName("F")
        .slides({0.01, 100.0, "%.2f", true});
    list.number(
            "env-max", light.mapMaximum,
            {std::numeric_limits<float>::min(), std::numeric_limits<float>::max(), "a finite number above 0"},
            "Dim what is brighter in the map, in its largest channel (default: only infinite light)")
        .withValueName("F")
        .needs({"env"});
    list.add("background", Setting::Kind::value, backgroundAccess(light), "The same radiance from everywhere")
        .withValueName("r,g,b")
        .excludes({"env", "sky", "sun"});
    list.add("sky", Setting::Kind::flag, skyAccess(light), "A clear sky with its sun")
        .excludes({"env", "background"});
    list.add("sun", Setting::Kind::value, sunAccess(light),
             "Where the sun stands, as a direction (default 45 degrees above +x)")
        .withValueName("x,y,z")
        .excludes({"env", "background"});
}

} // namespace metamarch
