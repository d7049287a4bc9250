// SPDX-License-Identifier: MIT
// Calls all load… functions of the scene with one index, on CPU and device.
#ifndef METAMARCH_TESTS_SHADING_LOADED_RECORDS_H
#define METAMARCH_TESTS_SHADING_LOADED_RECORDS_H
#include "metamarch/shared/light.h"
#include "metamarch/shared/light_node.h"
#include "metamarch/shared/shading_layout.h"
#ifdef __cplusplus
#include "metamarch/shared/shading_scene.h"
#endif

SHARED_BEGIN

const uint kLoadedRecords = 5u;

struct LoadedRecords {
    Surface surface;
    Vertex vertex;
    vec4 color;
    vec4 tangent;
    MaterialRecord material;
    TextureLevel level;
    TextureUse use;
    Emitter emitter;
    LightRecord light;
    LightNode node;
    TableEntry table;
    vec4 environment;
    vec3 vertexNormal;
    uint texel0;
    uint texel1;
    uint texel2;
    uint texel3;
    uint padding0;
};

SHARED_FN LoadedRecords loadedRecords(SCENE_PARAMETER const uint i) {
    LoadedRecords loaded;
    loaded.surface = loadSurface(SCENE i);
    loaded.vertex = loadVertex(SCENE i);
    loaded.color = loadColor(SCENE i);
    loaded.tangent = loadTangent(SCENE i);
    loaded.material = loadMaterial(SCENE i);
    loaded.level = loadTextureLevel(SCENE i);
    loaded.use = loadTextureUse(SCENE i);
    loaded.emitter = loadEmitter(SCENE i);
    loaded.light = loadLight(SCENE i);
    loaded.node = loadLightNode(SCENE kLoadedRecords, i);
    loaded.table = loadTableEntry(SCENE i);
    loaded.environment = loadEnvironment(SCENE i);
    loaded.vertexNormal = loadVertexNormal(SCENE i);
    loaded.texel0 = loadTexel(SCENE 0u, i);
    loaded.texel1 = loadTexel(SCENE 1u, i);
    loaded.texel2 = loadTexel(SCENE 2u, i);
    loaded.texel3 = loadTexel(SCENE 3u, i);
    loaded.padding0 = 0u;
    return loaded;
}

SHARED_ASSERT_SIZE(LoadedRecords, 320 + 16 * kMaterialRows)
SHARED_ASSERT_OFFSET(LoadedRecords, material, 80)

SHARED_END
#endif
