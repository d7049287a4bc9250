// SPDX-License-Identifier: MIT
#include "metamarch/cli/scene_report.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace metamarch::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLines = 50; // of one list, as text

// A name of a file may hold terminal escapes and bytes that are no UTF-8; JSON shows them as they can be
// printed.
std::string printable(const std::string& name) {
    const std::string quoted = Json(name).dump(-1, ' ', false, Json::error_handler_t::replace);
    return quoted.substr(1, quoted.size() - 2);
}

double degrees(const float radians) { return static_cast<double>(radians) * 180.0 / glm::pi<double>(); }

std::string typeText(const PunctualLight::Type type) {
    switch (type) {
    case PunctualLight::Type::directional:
        return "directional";
    case PunctualLight::Type::point:
        return "point";
    case PunctualLight::Type::spot:
        return "spot";
    }
    return "";
}

Json toArray(const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); }

bool isPerspective(const SceneCamera& camera) {
    return camera.projection == SceneCamera::Projection::perspective;
}

Json toJson(const SceneCamera& camera) {
    Json json = {{"name", camera.name},
                 {"projection", isPerspective(camera) ? "perspective" : "orthographic"},
                 {"eye", toArray(camera.eye)},
                 {"forward", toArray(camera.forward)},
                 {"up", toArray(camera.up)}};
    if (isPerspective(camera)) {
        json["verticalFov"] = degrees(camera.verticalFov);
    } else {
        json["height"] = camera.verticalExtent;
    }
    return json;
}

Json toJson(const PunctualLight& light) {
    Json json = {{"name", light.name},
                 {"type", typeText(light.type)},
                 {"color", toArray(light.color)},
                 {"intensity", light.intensity}};
    if (light.type != PunctualLight::Type::directional) {
        json["position"] = toArray(light.position);
    }
    if (light.type != PunctualLight::Type::point) {
        json["direction"] = toArray(light.direction);
    }
    return json;
}

std::vector<std::size_t> trianglesOfMaterials(const Scene& scene) {
    std::vector<std::size_t> counts(scene.materials.size());
    for (const std::uint32_t material : scene.triangleMaterial) {
        if (material != kNoMaterial) {
            ++counts[material];
        }
    }
    return counts;
}

// Returns lines like "cameras      0 'front': perspective". `describe` returns what follows the name.
template <class Elements, class Name, class Describe>
std::string listText(const char* const label, const Elements& elements, const Name& name,
                     const Describe& describe) {
    std::string text;
    for (std::size_t i = 0; i < std::min(elements.size(), kMostLines); ++i) {
        const std::string details = describe(i);
        text += fmt::format("{:<12} {} '{}'{}{}\n", i == 0 ? label : "", i, printable(name(elements[i])),
                            details.empty() ? "" : ": ", details);
    }
    if (elements.size() > kMostLines) {
        text += fmt::format("{:<12} and {} more, see --json\n", "", elements.size() - kMostLines);
    }
    return text;
}

} // namespace

Json reportContents(const Scene& scene) {
    Json report = {{"scenes", scene.scenes},     {"cameras", Json::array()}, {"animations", Json::array()},
                   {"variants", scene.variants}, {"lights", Json::array()},  {"materials", Json::array()}};
    for (const SceneCamera& camera : scene.cameras) {
        report["cameras"].push_back(toJson(camera));
    }
    for (const SceneAnimation& animation : scene.animations) {
        report["animations"].push_back({{"name", animation.name}, {"seconds", animation.seconds}});
    }
    for (const PunctualLight& light : scene.lights) {
        report["lights"].push_back(toJson(light));
    }
    const std::vector<std::size_t> triangles = trianglesOfMaterials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        report["materials"].push_back({{"name", scene.materials[i].name}, {"triangles", triangles[i]}});
    }
    return report;
}

std::string contentsText(const Scene& scene) {
    const auto nameOf = [](const auto& element) { return element.name; };
    const std::vector<std::size_t> triangles = trianglesOfMaterials(scene);
    const auto itself = [](const std::string& name) { return name; };
    const auto nothing = [](std::size_t) { return std::string(); };
    return listText("scenes", scene.scenes, itself, nothing) +
           listText("cameras", scene.cameras, nameOf,
                    [&](const std::size_t i) {
                        const SceneCamera& camera = scene.cameras[i];
                        return isPerspective(camera)
                                   ? fmt::format("perspective, vertical field of view {:.4g} degrees",
                                                 degrees(camera.verticalFov))
                                   : fmt::format("orthographic, height {:.4g}", camera.verticalExtent);
                    }) +
           listText("animations", scene.animations, nameOf,
                    [&](const std::size_t i) {
                        return fmt::format("{:.4g} seconds", scene.animations[i].seconds);
                    }) +
           listText("variants", scene.variants, itself, nothing) +
           listText("lights", scene.lights, nameOf,
                    [&](const std::size_t i) {
                        const PunctualLight& light = scene.lights[i];
                        const bool isSun = light.type == PunctualLight::Type::directional;
                        return fmt::format("{}, {:.4g} {}", typeText(light.type), light.intensity,
                                           isSun ? "lux" : "candela");
                    }) +
           listText("materials", scene.materials, nameOf,
                    [&](const std::size_t i) { return fmt::format("{} triangles", triangles[i]); });
}

} // namespace metamarch::cli
