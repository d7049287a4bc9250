// SPDX-License-Identifier: MIT
#include "metamarch/shading/surroundings.h"

#include "metamarch/shading/light/sky.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

namespace metamarch {
namespace {

bool isLamp(const Material& material) {
    const bool isPainted = material.emissiveTexture.texture != kNoTexture;
    return material.emissiveFactor != glm::vec3(0.0f) && (!isPainted || material.emissiveStrength > 1.0f);
}

// Keeps the last sky: the pictures of a batch mostly have the same one, and it takes longer than a thumbnail.
Sky skyOf(const LightChoice& light) {
    static std::mutex mutex;
    static std::optional<std::pair<SkySettings, Sky>> kept;
    SkySettings settings;
    settings.sunElevation = light.sunElevation;
    settings.sunAzimuth = light.sunAzimuth;
    {
        const std::scoped_lock lock(mutex);
        if (kept && kept->first == settings) {
            return kept->second;
        }
    }
    // Without the lock: a thread that waits for others in there may be given work that wants a sky too.
    Sky sky = makeSky(settings);
    const std::scoped_lock lock(mutex);
    kept.emplace(settings, sky);
    return sky;
}

void addSky(const LightChoice& light, Surroundings& surroundings) {
    Sky sky = skyOf(light);
    sky.sun.strength *= light.intensity;
    surroundings.environment = std::move(sky.environment);
    if (sky.sun.strength != glm::vec3(0.0f)) {
        surroundings.sun = sky.sun;
    }
}

} // namespace

bool hasLight(const Scene& scene) {
    return !scene.lights.empty() || std::ranges::any_of(scene.triangleMaterial, [&](const std::uint32_t id) {
        return id != kNoMaterial && isLamp(scene.materials[id]);
    });
}

Surroundings makeSurroundings(const Scene& scene, const std::string& name, const LightChoice& light) {
    Surroundings surroundings;
    surroundings.rotation = light.rotation;
    surroundings.intensity = light.intensity;
    switch (light.kind) {
    case LightChoice::Kind::background:
        surroundings.background = light.background;
        break;
    case LightChoice::Kind::map:
        surroundings.environment = loadEnvironment(light.map, light.mapMaximum);
        surroundings.warnings = surroundings.environment->warnings;
        break;
    case LightChoice::Kind::sky:
        addSky(light, surroundings);
        break;
    case LightChoice::Kind::automatic:
        if (!hasLight(scene)) {
            surroundings.warnings.push_back(name + ": no light; a clear sky lights it");
            addSky(light, surroundings);
        }
        break;
    }
    return surroundings;
}

} // namespace metamarch
