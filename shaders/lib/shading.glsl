// SPDX-License-Identifier: MIT
// Loads the data of the scene that the path tracer reads. shared/shading_scene.h has the same functions for
// the CPU.
#ifndef METAMARCH_LIB_SHADING_GLSL
#define METAMARCH_LIB_SHADING_GLSL
#include "lib/memory.glsl"
#include "shared/scene_layout.h"
#include "shared/shading_layout.h"

layout(constant_id = kSpecFeatures) const uint sceneFeatures = 0xffffffffu;
#define SHADING_FEATURES sceneFeatures
#include "shared/features.h"
#include "shared/light.h"
#include "shared/light_node.h"

WORDS4(surfaceWords, kBindSurfaces);
WORDS4(vertexWords, kBindVertices);
WORDS4(colorWords, kBindColors);
WORDS4(tangentWords, kBindTangents);
WORDS4(materialWords, kBindMaterialRecords);
WORDS4(textureWords, kBindTextures);
WORDS4(emitterWords, kBindEmitters);
WORDS4(lightWords, kBindLights);
WORDS4(tableWords, kBindTables);
WORDS4(environmentWords, kBindEnvironment);
WORDS1(texelWords0, kBindTexels);
WORDS1(texelWords1, kBindTexels + 1u);
WORDS1(texelWords2, kBindTexels + 2u);
WORDS1(texelWords3, kBindTexels + 3u);

Surface loadSurface(const uint triangleId) {
    const uvec4 words = LOAD4(surfaceWords, triangleId);
    return Surface(words.x, words.y, words.z, words.w);
}

vec3 loadVertexNormal(const uint i) { return uintBitsToFloat(LOAD4(vertexWords, 2u * i).xyz); }

Vertex loadVertex(const uint i) {
    const vec4 a = uintBitsToFloat(LOAD4(vertexWords, 2u * i));
    const uvec4 words = LOAD4(vertexWords, 2u * i + 1u);
    const vec3 b = uintBitsToFloat(words.xyz);
    return Vertex(a.xyz, a.w, b.x, b.y, b.z, words.w);
}

vec4 loadColor(const uint i) { return uintBitsToFloat(LOAD4(colorWords, i)); }
vec4 loadTangent(const uint i) { return uintBitsToFloat(LOAD4(tangentWords, i)); }

// Loads the rows of material_rows.inc that the scene uses.
MaterialRecord loadMaterial(const uint i) {
    MaterialRecord record;
#define PARAMETER(type, name, value) record.name = type(0);
#define TEXTURE(name, value) record.name = kNoTextureRecord;
#include "shared/material_rows.inc"

    // Here an entry becomes `name = conversion`, so that record.X(words.x) reads
    // record.metallic = uintBitsToFloat(words.x).
    uint row = i * kMaterialRows;
#define BITS_TO_float uintBitsToFloat
#define BITS_TO_vec3 uintBitsToFloat
#define BITS_TO_uint
#define PARAMETER(type, name, value) name = BITS_TO_##type
#define TEXTURE(name, value) name =
#define MATERIAL_ROW(condition, X, Y, Z, W)                                                                  \
    if (condition) {                                                                                         \
        const uvec4 words = LOAD4(materialWords, row);                                                       \
        record.X(words.x);                                                                                   \
        record.Y(words.y);                                                                                   \
        record.Z(words.z);                                                                                   \
        record.W(words.w);                                                                                   \
    }                                                                                                        \
    ++row;
#define MATERIAL_VECTOR_ROW(condition, XYZ, W)                                                               \
    if (condition) {                                                                                         \
        const uvec4 words = LOAD4(materialWords, row);                                                       \
        record.XYZ(words.xyz);                                                                               \
        record.W(words.w);                                                                                   \
    }                                                                                                        \
    ++row;
#include "shared/material_rows.inc"
    return record;
}

TextureLevel loadTextureLevel(const uint i) {
    const uvec4 words = LOAD4(textureWords, 3u * i);
    return TextureLevel(words.x, words.y, words.z, words.w);
}

TextureUse loadTextureUse(const uint i) {
    const vec4 u = uintBitsToFloat(LOAD4(textureWords, 3u * i + 1u));
    const uvec4 v = LOAD4(textureWords, 3u * i + 2u);
    return TextureUse(u.xyz, u.w, uintBitsToFloat(v.xyz), v.w);
}

uint loadTexel(const uint chunk, const uint word) {
    if (chunk == 0u) {
        return LOAD1(texelWords0, word);
    }
    if (chunk == 1u) {
        return LOAD1(texelWords1, word);
    }
    if (chunk == 2u) {
        return LOAD1(texelWords2, word);
    }
    return LOAD1(texelWords3, word);
}

Emitter loadEmitter(const uint i) {
    const uvec4 a = LOAD4(emitterWords, 3u * i);
    const uvec4 b = LOAD4(emitterWords, 3u * i + 1u);
    const uvec4 c = LOAD4(emitterWords, 3u * i + 2u);
    return Emitter(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}

LightRecord loadLight(const uint i) {
    const uvec4 a = LOAD4(lightWords, 3u * i);
    const vec4 b = uintBitsToFloat(LOAD4(lightWords, 3u * i + 1u));
    const vec4 c = uintBitsToFloat(LOAD4(lightWords, 3u * i + 2u));
    return LightRecord(uintBitsToFloat(a.xyz), a.w, b.xyz, b.w, c.xyz, c.w);
}

// Nodes follow the punctual lights in their buffer, because lavapipe has no more than 32 storage buffers.
LightNode loadLightNode(const uint punctualCount, const uint i) {
    const uint row = 3u * punctualCount + 2u * i;
    const vec4 a = uintBitsToFloat(LOAD4(lightWords, row));
    const uvec4 b = LOAD4(lightWords, row + 1u);
    return LightNode(a.xyz, a.w, b.x, b.y, uintBitsToFloat(b.z), b.w);
}

TableEntry loadTableEntry(const uint i) {
    const uvec4 words = LOAD4(tableWords, i);
    return TableEntry(uintBitsToFloat(words.x), uintBitsToFloat(words.y), uintBitsToFloat(words.z), words.w);
}
vec4 loadEnvironment(const uint i) { return uintBitsToFloat(LOAD4(environmentWords, i)); }
#endif
