#include "scene/gltf_material.h"

#include <algorithm>
#include <limits>

namespace metamarch {
namespace {

float factor(double value, double largest) { return static_cast<float>(std::clamp(value, 0.0, largest)); }

// KHR_materials_emissive_strength; 1 without it.
double emissiveStrength(const tinygltf::Material& source) {
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension == source.extensions.end() || !extension->second.Has("emissiveStrength"))
        return 1.0;
    const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
    return strength.IsNumber() ? strength.GetNumberAsDouble() : 1.0;
}

} // namespace

Material readMaterial(const tinygltf::Material& source) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    // tinygltf has refused arrays of other lengths, and leaves the emissive factor empty when there is none.
    for (int channel = 0; channel < 4; ++channel)
        material.baseColor[channel] = factor(pbr.baseColorFactor[static_cast<std::size_t>(channel)], 1.0);
    const double strength = emissiveStrength(source);
    for (std::size_t channel = 0; channel < source.emissiveFactor.size(); ++channel)
        material.emission[static_cast<int>(channel)] =
            factor(source.emissiveFactor[channel] * strength, std::numeric_limits<float>::max());
    material.metallic = factor(pbr.metallicFactor, 1.0);
    material.roughness = factor(pbr.roughnessFactor, 1.0);
    material.doubleSided = source.doubleSided;
    return material;
}

} // namespace metamarch
