// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/light.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamarch {
namespace {

PunctualLight::Type readType(const GltfElement& source) {
    const std::string type = source.text("type");
    if (type == "directional") {
        return PunctualLight::Type::directional;
    }
    if (type == "point") {
        return PunctualLight::Type::point;
    }
    if (type == "spot") {
        return PunctualLight::Type::spot;
    }
    source.refuse("type '" + type + "' is none of directional, point, spot");
}

void readCone(const GltfElement& spot, PunctualLight& light) {
    const double outer = spot.number("outerConeAngle", glm::quarter_pi<double>());
    light.outerConeAngle = static_cast<float>(std::clamp(outer, 0.0, glm::half_pi<double>()));
    light.innerConeAngle =
        std::clamp(static_cast<float>(spot.number("innerConeAngle", 0.0)), 0.0f, light.outerConeAngle);
}

} // namespace

std::optional<PunctualLight> readLight(const GltfElement& source, const glm::dmat4& toWorld, double scale) {
    PunctualLight light;
    light.name = source.text("name");
    light.type = readType(source);
    light.color = glm::vec3(glm::clamp(source.vector<3>("color", glm::dvec3(1.0)), 0.0, 1.0));
    const double unit = light.type == PunctualLight::Type::directional ? 1.0 : scale * scale;
    light.intensity = static_cast<float>(
        std::clamp(source.number("intensity", 1.0) * unit, 0.0, double{std::numeric_limits<float>::max()}));
    if (light.type == PunctualLight::Type::spot) {
        readCone(source.object("spot"), light);
    }

    light.position = glm::vec3(toWorld[3]);
    const glm::dvec3 along = -glm::dvec3(toWorld[2]);
    const double length = glm::length(along);
    const bool isPlaced = std::isfinite(glm::length(glm::dvec3(light.position)));
    const bool isDirected = std::isfinite(length) && length > 0.0;
    if (isDirected) {
        light.direction = glm::vec3(along / length);
    }
    const bool sound = (isPlaced || light.type == PunctualLight::Type::directional) &&
                       (isDirected || light.type == PunctualLight::Type::point);
    return sound ? std::optional(light) : std::nullopt;
}

} // namespace metamarch
