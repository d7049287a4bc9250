#include "metamarch/cli/light_options.h"

#include "metamarch/cli/number_list.h"
#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace metamarch::cli {

void LightOptions::addTo(CLI::App& command) {
    const std::string group = "Light (default: the scene's; a clear sky where it has none)";
    command.add_option("--env", environment, "Equirectangular map, HDR or EXR, lit from and seen all around")
        ->type_name("FILE")
        ->group(group);
    command.add_option("--env-rotation", rotation, "Turn the map around y, from +z towards +x")
        ->type_name("DEG")
        ->group(group);
    command.add_option("--env-intensity", intensity, "Multiply the radiance of map or sky (default 1)")
        ->type_name("F")
        ->group(group);
    command.add_option("--background", background, "The same radiance from everywhere")
        ->type_name("r,g,b")
        ->group(group);
    command.add_flag("--sky", sky, "A clear sky with its sun")->group(group);
    command.add_option("--sun", sun, "Where the sun stands, as a direction (default 45 degrees above +x)")
        ->type_name("x,y,z")
        ->group(group);
}

void LightOptions::check() const {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    const bool hasSky = sky || !sun.empty();
    if (int{!environment.empty()} + int{!background.empty()} + int{hasSky} > 1) {
        refuse("--env, --background and --sky (--sun) exclude each other");
    }
    if (!std::isfinite(rotation)) {
        refuse(fmt::format("--env-rotation {}: give finite degrees", rotation));
    }
    if (intensity && !(std::isfinite(*intensity) && *intensity >= 0.0)) {
        refuse(fmt::format("--env-intensity {}: give a finite number of at least 0", *intensity));
    }
    if (!background.empty()) {
        const glm::dvec3 color = parsePoint("--background", background);
        if (glm::any(glm::lessThan(color, glm::dvec3(0.0)))) {
            refuse(fmt::format("--background {}: radiance is at least 0", background));
        }
    }
    if (!sun.empty() && parsePoint("--sun", sun) == glm::dvec3(0.0)) {
        refuse(fmt::format("--sun {}: no direction", sun));
    }
}

LightChoice LightOptions::parse() const {
    using Kind = LightChoice::Kind;
    LightChoice choice;
    choice.rotation = static_cast<float>(std::fmod(rotation, 360.0) * std::numbers::pi / 180.0);
    choice.intensity = static_cast<float>(intensity.value_or(1.0));
    if (!background.empty()) {
        choice.kind = Kind::background;
        choice.background = glm::vec3(parsePoint("--background", background));
    } else if (!environment.empty()) {
        choice.kind = Kind::map;
        choice.map = environment;
    } else if (sky || !sun.empty()) {
        choice.kind = Kind::sky;
        if (!sun.empty()) {
            const glm::dvec3 direction = glm::normalize(parsePoint("--sun", sun));
            choice.sunElevation = static_cast<float>(std::asin(direction.y));
            choice.sunAzimuth = static_cast<float>(std::atan2(direction.z, direction.x));
        }
    }
    return choice;
}

} // namespace metamarch::cli
