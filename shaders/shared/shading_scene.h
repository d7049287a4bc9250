// SPDX-License-Identifier: MIT
// The data of a scene that the path tracer reads, in the layout of the device's buffers, and the functions
// with which the CPU reads it.
#pragma once
#include "features.h"
#include "light.h"
#include "light_node.h"
#include "path_settings.h"
#include "shading_layout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace metamarch {

struct ShadingScene {
    std::uint32_t features = 0;    // kFeature… bits that the scene uses
    std::vector<Surface> surfaces; // [triangleId]
    std::vector<Vertex> vertices;
    std::vector<glm::vec4> colors;   // [vertex], with kFeatureColors
    std::vector<glm::vec4> tangents; // [vertex], with kFeatureNormalMaps or kFeatureAnisotropy
    std::vector<MaterialRecord> materials;
    std::vector<TextureRecord> textures;
    std::array<std::vector<std::uint32_t>, kTexelChunks> texels;
    std::vector<Emitter> emitters;
    std::vector<LightRecord> lights;
    std::vector<LightNode> lightNodes; // with kFeatureLightTree; the root is the first
    // The map's texels, with kFeatureEnvironment: radiance in rgb, the weight for sampling in a.
    std::vector<glm::vec4> environment;
    // One table for all lights (PathSettings::lightCount), one for the map's rows of cells, and one
    // for the columns of each row.
    std::vector<TableEntry> tables;
    PathSettings settings{}; // the scene sets the members about lights
};

// The CPU's counterparts of the functions in shaders/lib/shading.glsl.
inline bool hasFeature(const ShadingScene& scene, const uint feature) {
    return (scene.features & feature) != 0u;
}
inline Surface loadSurface(const ShadingScene& scene, const uint triangleId) {
    return scene.surfaces[triangleId];
}
inline glm::vec3 loadVertexNormal(const ShadingScene& scene, const uint i) {
    return scene.vertices[i].normal;
}
inline Vertex loadVertex(const ShadingScene& scene, const uint i) { return scene.vertices[i]; }
inline glm::vec4 loadColor(const ShadingScene& scene, const uint i) {
    return scene.colors.empty() ? glm::vec4(1.0f) : scene.colors[i];
}
inline glm::vec4 loadTangent(const ShadingScene& scene, const uint i) {
    return scene.tangents.empty() ? glm::vec4(0.0f) : scene.tangents[i];
}
inline MaterialRecord loadMaterial(const ShadingScene& scene, const uint i) { return scene.materials[i]; }
inline TextureLevel loadTextureLevel(const ShadingScene& scene, const uint i) {
    return scene.textures[i].level;
}
inline TextureUse loadTextureUse(const ShadingScene& scene, const uint i) { return scene.textures[i].use; }
inline std::uint32_t loadTexel(const ShadingScene& scene, const uint chunk, const uint word) {
    return scene.texels[chunk][word];
}
inline Emitter loadEmitter(const ShadingScene& scene, const uint i) { return scene.emitters[i]; }
inline LightRecord loadLight(const ShadingScene& scene, const uint i) { return scene.lights[i]; }
// On the device the nodes follow the punctual lights in one buffer; see lib/shading.glsl.
inline LightNode loadLightNode(const ShadingScene& scene, uint /*punctualCount*/, const uint i) {
    return scene.lightNodes[i];
}
inline TableEntry loadTableEntry(const ShadingScene& scene, const uint i) { return scene.tables[i]; }
inline glm::vec4 loadEnvironment(const ShadingScene& scene, const uint i) { return scene.environment[i]; }

} // namespace metamarch
