// SPDX-License-Identifier: MIT
#include "metamarch/render/scene_hash.h"

#include "metamarch/file/content_hash.h"

namespace metamarch::render {

std::string sceneHash(const PreparedScene& prepared) {
    ContentHash hash;
    const Scene& scene = *prepared.scene;
    hash.addAll(scene.positions);
    hash.addAll(scene.triangles);
    hash.addAll(scene.triangleMaterial);
    if (prepared.shading != nullptr) {
        const ShadingScene& shading = *prepared.shading;
        hash.addAll(shading.surfaces);
        hash.addAll(shading.vertices);
        hash.addAll(shading.colors);
        hash.addAll(shading.tangents);
        hash.addAll(shading.materials);
        hash.addAll(shading.textures);
        for (const std::vector<std::uint32_t>& chunk : shading.texels) {
            hash.addAll(chunk);
        }
        hash.addAll(shading.emitters);
        hash.addAll(shading.lights);
        hash.addAll(shading.lightNodes);
        hash.addAll(shading.environment);
        hash.addAll(shading.tables);
        hash.add(std::as_bytes(std::span(&shading.settings, 1)));
    }
    return hash.text();
}

} // namespace metamarch::render
