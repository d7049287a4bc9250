#include "metamarch/shading/lit_scene.h"

#include "metamarch/shading/light/sky.h"

#include <algorithm>
#include <utility>

namespace metamarch {
namespace {

// Every device lets a shader see that much of a buffer.
constexpr std::uint64_t kTexelChunkBytes = std::uint64_t{128} << 20u;

bool isLamp(const Material& material) {
    const bool isPainted = material.emissiveTexture.texture != kNoTexture;
    return material.emissiveFactor != glm::vec3(0.0f) && (!isPainted || material.emissiveStrength > 1.0f);
}

void addSky(const LightChoice& light, Surroundings& surroundings) {
    SkySettings settings;
    settings.sunElevation = light.sunElevation;
    settings.sunAzimuth = light.sunAzimuth;
    Sky sky = makeSky(settings);
    sky.sun.strength *= light.intensity;
    surroundings.environment = std::move(sky.environment);
    if (sky.sun.strength != glm::vec3(0.0f)) {
        surroundings.sun = sky.sun;
    }
}

Surroundings surround(const Scene& scene, const std::string& name, const LightChoice& light,
                      std::vector<std::string>& warnings) {
    Surroundings surroundings;
    surroundings.rotation = light.rotation;
    surroundings.intensity = light.intensity;
    switch (light.kind) {
    case LightChoice::Kind::background:
        surroundings.background = light.background;
        break;
    case LightChoice::Kind::map:
        surroundings.environment = loadEnvironment(light.map);
        warnings = surroundings.environment->warnings;
        break;
    case LightChoice::Kind::sky:
        addSky(light, surroundings);
        break;
    case LightChoice::Kind::automatic:
        if (!hasLight(scene)) {
            warnings.push_back(name + ": no light; a clear sky lights it");
            addSky(light, surroundings);
        }
        break;
    }
    return surroundings;
}

} // namespace

bool hasLight(const Scene& scene) {
    return !scene.lights.empty() || std::ranges::any_of(scene.triangleMaterial, [&](const std::uint32_t id) {
        return id != kNoMaterial && isLamp(scene.materials[id]);
    });
}

LitScene lightScene(const Scene& scene, const std::string& name, const PathChoice& path,
                    const LightChoice& light) {
    LitScene lit;
    Surroundings surroundings;
    if (path.isOcclusion()) {
        surroundings.background = glm::vec3(1.0f);
    } else {
        surroundings = surround(scene, name, light, lit.warnings);
    }
    lit.shading = makeShadingScene(scene, surroundings, path.shading(), kTexelChunkBytes);
    return lit;
}

} // namespace metamarch
