// SPDX-License-Identifier: MIT
#include "looks.h"

#include "random_bsdf_case.h"

#include <cmath>

namespace metamarch {

std::vector<Look> looks() {
    std::vector<Look> all;
    const auto add = [&](const std::string& name, auto change) {
        SurfaceMaterial material = plainMaterial();
        material.baseColor = vec3(0.8f, 0.6f, 0.4f);
        material.roughness = 0.5f;
        change(material);
        all.push_back({name, material});
    };
    const auto glass = [](SurfaceMaterial& m, float roughness, uint flags) {
        m.transmission = 1.0f;
        m.roughness = roughness;
        m.flags = flags;
    };
    add("shinyMetal", [](auto& m) { m.metallic = 1.0f, m.roughness = 0.25f; });
    add("metal", [](auto& m) { m.metallic = 1.0f; });
    add("roughMetal", [](auto& m) { m.metallic = 1.0f, m.roughness = 1.0f; });
    add("brushedMetal", [](auto& m) { m.metallic = 1.0f, m.roughness = 0.3f, m.anisotropy = 0.7f; });
    add("matte", [](auto& m) { m.specular = 0.0f; });
    add("plastic", [](auto& m) { m.roughness = 0.3f; });
    add("singleScatterPlastic", [](auto& m) { m.flags = kSurfaceSingleScatter; });
    add("halfMetal", [](auto& m) { m.metallic = 0.5f; });
    add("thinGlass", [&](auto& m) { glass(m, 0.3f, 0u); });
    add("singleScatterThinGlass", [&](auto& m) { glass(m, 0.6f, kSurfaceSingleScatter); });
    add("glass", [&](auto& m) { glass(m, 0.4f, kSurfaceVolume); });
    add("roughGlass", [&](auto& m) { glass(m, 0.9f, kSurfaceVolume); });
    add("singleScatterGlass", [&](auto& m) { glass(m, 0.5f, kSurfaceVolume | kSurfaceSingleScatter); });
    add("brushedDiamond",
        [&](auto& m) { glass(m, 0.3f, kSurfaceVolume), m.ior = 2.4f, m.anisotropy = 0.5f; });
    add("milkGlass", [&](auto& m) { glass(m, 0.5f, kSurfaceVolume), m.transmission = 0.5f; });
    add("leaf", [](auto& m) { m.diffuseTransmission = 0.6f; });
    add("paint", [](auto& m) { m.coat = 1.0f, m.coatRoughness = 0.25f; });
    add("smoothPaint", [](auto& m) { m.coat = 1.0f, m.metallic = 0.8f; });
    add("velvet", [](auto& m) { m.sheenColor = vec3(0.9f, 0.5f, 0.9f), m.sheenRoughness = 0.4f; });
    add("soapFilm", [](auto& m) { m.iridescence = 1.0f, m.roughness = 0.3f; });
    add("everything", [](auto& m) {
        m.metallic = 0.3f, m.specularColor = vec3(2.0f, 0.5f, 1.0f), m.coat = 0.7f, m.coatRoughness = 0.3f;
        m.sheenColor = vec3(0.4f), m.sheenRoughness = 0.6f, m.iridescence = 0.5f, m.transmission = 0.4f;
        m.diffuseTransmission = 0.5f, m.anisotropy = 0.4f, m.flags = kSurfaceVolume;
    });
    return all;
}

std::string nameOf(const testing::TestParamInfo<Look>& info) { return info.param.name; }

std::ostream& operator<<(std::ostream& stream, const Look& look) { return stream << look.name; }

vec3 directionOf(float cosine) {
    const float sine = std::sqrt(1.0f - cosine * cosine);
    return vec3(0.8f * sine, 0.6f * sine, cosine);
}

SurfaceFrame tiltedFrame(vec3 wo, float tilt) {
    return makeSurfaceFrame(vec3(0.0f, 0.0f, 1.0f), unitVector(vec3(tilt, 0.0f, 1.0f)),
                            unitVector(vec3(0.0f, 0.5f * tilt, 1.0f)), vec3(0.6f, 0.8f, 0.0f), wo);
}

} // namespace metamarch
