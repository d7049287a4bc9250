// SPDX-License-Identifier: MIT
#include "metamarch/shading/shading.h"

namespace metamarch {

std::vector<Material> materialsWithGrey(const Scene& scene) {
    Material grey;
    grey.baseColorFactor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    grey.metallicFactor = 0.0f;
    std::vector<Material> materials = scene.materials;
    materials.push_back(grey);
    return materials;
}

std::uint32_t materialOf(const Scene& scene, const std::size_t triangleId) {
    const std::uint32_t material = scene.triangleMaterial[triangleId];
    return material == kNoMaterial ? static_cast<std::uint32_t>(scene.materials.size()) : material;
}

ShadingData makeShadingData(const Scene& scene) {
    ShadingData data;
    for (const Material& material : materialsWithGrey(scene)) {
        data.materials.push_back({glm::vec3(material.baseColorFactor), material.baseColorFactor.a});
    }
    data.materialOfTriangle.resize(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        data.materialOfTriangle[i] = materialOf(scene, i);
    }
    return data;
}

} // namespace metamarch
