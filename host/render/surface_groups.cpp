// SPDX-License-Identifier: MIT
#include "metamarch/render/surface_groups.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace metamarch::render {
namespace {

std::string objectName(const MeshInstance& instance) {
    const std::string& name = instance.node.empty() ? instance.name : instance.node;
    return name.empty() ? fmt::format("mesh {}", instance.mesh) : name;
}

std::string assetName(const MeshInstance& instance) {
    return instance.root.empty() ? objectName(instance) : instance.root;
}

std::string materialName(const Scene& scene, const std::uint32_t material) {
    if (material == kNoMaterial) {
        return "no material";
    }
    const std::string& name = scene.materials[material].name;
    return name.empty() ? fmt::format("material {}", material) : name;
}

} // namespace

SurfaceGroups groupSurfaces(const Scene& scene) {
    SurfaceGroups groups;
    groups.levels = {{"CryptoObject", {}}, {"CryptoMaterial", {}}, {"CryptoAsset", {}}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known; // instance and material
    groups.ofTriangle.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::pair surface(scene.triangleMesh[i], scene.triangleMaterial[i]);
        const auto [found, isNew] = known.emplace(surface, static_cast<std::uint32_t>(known.size()));
        if (isNew) {
            const MeshInstance& instance = scene.meshes[surface.first];
            groups.levels[0].nameOfGroup.push_back(objectName(instance));
            groups.levels[1].nameOfGroup.push_back(materialName(scene, surface.second));
            groups.levels[2].nameOfGroup.push_back(assetName(instance));
        }
        groups.ofTriangle.push_back(found->second);
    }
    return groups;
}

} // namespace metamarch::render
