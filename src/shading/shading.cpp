#include "metamarch/shading/shading.h"

#include <algorithm>

namespace metamarch {

ShadingData makeShadingData(const Scene& scene) {
    constexpr ShadingMaterial kGrey{glm::vec3(0.8f), 1.0f};
    ShadingData data;
    for (const Material& material : scene.materials) {
        data.materials.push_back({glm::vec3(material.baseColorFactor), material.baseColorFactor.a});
    }
    const auto fallback = static_cast<std::uint32_t>(data.materials.size());
    data.materials.push_back(kGrey);
    data.materialOfTriangle = scene.triangleMaterial;
    std::replace(data.materialOfTriangle.begin(), data.materialOfTriangle.end(), kNoMaterial, fallback);
    return data;
}

} // namespace metamarch
