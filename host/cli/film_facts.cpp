// SPDX-License-Identifier: MIT
#include "metamarch/cli/film_facts.h"

#include "metamarch/cli/version.h"
#include "metamarch/error/error.h"
#include "metamarch/render/scene_hash.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace metamarch::cli {
namespace {

using Json = nlohmann::ordered_json;

std::array<float, 3> numbers(const glm::vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 vectorOf(const Json& json) {
    const auto v = json.get<std::array<float, 3>>();
    return {v[0], v[1], v[2]};
}

// Every float keeps its bits: it is written with the digits that its double needs.
std::string textOf(const SceneCamera& camera) {
    const Json json = {{"name", camera.name},
                       {"orthographic", camera.projection == SceneCamera::Projection::orthographic},
                       {"eye", numbers(camera.eye)},
                       {"forward", numbers(camera.forward)},
                       {"up", numbers(camera.up)},
                       {"verticalFov", camera.verticalFov},
                       {"verticalExtent", camera.verticalExtent}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::span<const std::string_view> settingsOfTheRun() {
    static constexpr std::string_view kNames[] = {
        "output",  "stats", "stamp",    "quiet",       "verbose",    "threads",    "preset",
        "samples", "crop",  "progress", "write-every", "time-limit", "checkpoint", "resume"};
    return kNames;
}

render::FilmFacts factsOf(const render::PreparedScene& scene, const SceneCamera& camera,
                          const render::RenderPlace& place, const SettingList& given) {
    render::FilmFacts facts = {{"version", programVersion()}, {"scene", render::sceneHash(scene)},
                               {"camera", textOf(camera)},    {"device", place.device},
                               {"driver", place.driver},      {"traversal", place.traversal}};
    for (const Setting& setting : given.all()) {
        const bool isOfTheRun =
            std::ranges::find(settingsOfTheRun(), setting.name()) != settingsOfTheRun().end();
        // More samples of the same picture are what a checkpoint is for.
        if (!setting.isPositional() && setting.isChanged() && !isOfTheRun && setting.name() != "spp") {
            facts.emplace_back("--" + setting.name(), setting.text());
        }
    }
    // The file has what is no UTF-8 replaced; so have these facts, to be equal.
    for (auto& [name, value] : facts) {
        value =
            Json::parse(Json(value).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
    }
    return facts;
}

void applyFacts(const render::FilmFacts& facts, const std::string& file, SettingList& settings) {
    for (const auto& [name, value] : facts) {
        if (!name.starts_with("--")) {
            continue;
        }
        try {
            settings.at(name.substr(2)).set(value);
        } catch (const std::exception&) {
            throw Error(ErrorKind::inputRefused,
                        fmt::format("{}: has a setting that this version does not know: {}", file, name));
        }
    }
}

SceneCamera cameraIn(const render::FilmFacts& facts, const std::string& file) {
    try {
        const Json json = Json::parse(render::factNamed(facts, "camera"));
        SceneCamera camera;
        camera.name = json.at("name");
        camera.projection = json.at("orthographic") ? SceneCamera::Projection::orthographic
                                                    : SceneCamera::Projection::perspective;
        camera.eye = vectorOf(json.at("eye"));
        camera.forward = vectorOf(json.at("forward"));
        camera.up = vectorOf(json.at("up"));
        camera.verticalFov = json.at("verticalFov");
        camera.verticalExtent = json.at("verticalExtent");
        return camera;
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::inputRefused, file + ": has no camera");
    }
}

render::RenderPlace placeIn(const render::FilmFacts& facts) {
    return {render::factNamed(facts, "device"), render::factNamed(facts, "driver"),
            render::factNamed(facts, "traversal")};
}

} // namespace metamarch::cli
