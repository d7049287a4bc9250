// SPDX-License-Identifier: MIT
#include "random_bsdf_case.h"

#include <random>

namespace metamarch {
namespace {

class CaseMaker {
  public:
    BsdfCase make();

  private:
    float even() { return even_(random_); }
    // Returns 0, 1 or a value between.
    float parameter() {
        const float kind = even();
        return kind < 0.25f ? 0.0f : kind < 0.4f ? 1.0f : even();
    }
    // Returns a parameter that is 0 for most materials.
    float feature() { return even() < 0.7f ? 0.0f : parameter(); }
    vec3 color() { return even() < 0.2f ? vec3(1.0f) : vec3(parameter(), even(), even()); }
    vec3 direction() { return unitVector(vec3(normal_(random_), normal_(random_), normal_(random_))); }
    SurfaceMaterial material();

    std::mt19937 random_{11};
    std::uniform_real_distribution<float> even_{0.0f, 0.99999994f};
    std::normal_distribution<float> normal_;
};

SurfaceMaterial CaseMaker::material() {
    SurfaceMaterial material = plainMaterial();
    material.baseColor = color();
    material.metallic = parameter();
    material.specularColor = color() * (even() < 0.2f ? 3.0f : 1.0f);
    material.specular = parameter();
    material.sheenColor = color() * feature();
    material.sheenRoughness = parameter();
    material.diffuseTransmissionColor = color();
    material.diffuseTransmission = feature();
    material.roughness = parameter();
    material.ior = even() < 0.1f ? 0.0f : 1.0f + 1.5f * parameter();
    material.transmission = feature();
    material.anisotropy = feature();
    material.coat = feature();
    material.coatRoughness = parameter();
    material.iridescence = feature();
    material.iridescenceIor = 1.0f + parameter();
    material.iridescenceThickness = 1200.0f * parameter();
    material.flags = random_() & 3u;
    return material;
}

BsdfCase CaseMaker::make() {
    BsdfCase made{};
    made.material = material();
    made.geometricNormal = direction();
    const float bump = even() < 0.3f ? 0.0f : even();
    made.shadingNormal = unitVector(made.geometricNormal + direction() * bump * 0.99f);
    made.coatNormal =
        even() < 0.5f ? made.shadingNormal : unitVector(made.geometricNormal + direction() * bump * 0.5f);
    made.tangent = even() < 0.2f ? vec3(0.0f) : direction();
    made.wo = direction();
    // Half of the directions are near the mirror direction, where the lobes are.
    const vec3 mirrored = made.shadingNormal * (2.0f * dotProduct(made.shadingNormal, made.wo)) - made.wo;
    made.wi = even() < 0.5f ? direction() : unitVector(mirrored + direction() * 0.2f * even());
    made.uLobe = even();
    made.uDirectionX = even();
    made.uDirectionY = even();
    return made;
}

} // namespace

SurfaceMaterial plainMaterial() {
    SurfaceMaterial material{};
    material.baseColor = vec3(1.0f);
    material.specularColor = vec3(1.0f);
    material.specular = 1.0f;
    material.diffuseTransmissionColor = vec3(1.0f);
    material.roughness = 1.0f;
    material.ior = 1.5f;
    material.iridescenceIor = 1.3f;
    material.iridescenceThickness = 400.0f;
    return material;
}

std::vector<BsdfCase> randomBsdfCases(std::size_t count) {
    CaseMaker maker;
    std::vector<BsdfCase> cases(count);
    for (BsdfCase& made : cases) {
        made = maker.make();
    }
    return cases;
}

} // namespace metamarch
