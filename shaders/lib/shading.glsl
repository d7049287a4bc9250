// What shading reads of the scene. src/scene/shading_scene.h has the same functions for the CPU.
#ifndef METAMARCH_LIB_SHADING_GLSL
#define METAMARCH_LIB_SHADING_GLSL
#include "lib/memory.glsl"
#include "shared/scene_layout.h"
#include "shared/shading_layout.h"

layout(constant_id = kSpecFeatures) const uint sceneFeatures = 0xffffffffu;
#define SHADING_FEATURES sceneFeatures
#include "shared/features.h"
#include "shared/light.h"

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
    const vec4 b = uintBitsToFloat(LOAD4(vertexWords, 2u * i + 1u));
    return Vertex(a.xyz, a.w, b.x, b.y, b.z, 0u);
}

vec4 loadColor(const uint i) { return uintBitsToFloat(LOAD4(colorWords, i)); }
vec4 loadTangent(const uint i) { return uintBitsToFloat(LOAD4(tangentWords, i)); }

// Rows that no material of the scene uses are not read: what they hold is not looked at.
uvec4 loadMaterialRow(const uint i, const uint row, const bool isUsed) {
    return isUsed ? LOAD4(materialWords, i * kMaterialRows + row) : uvec4(0u);
}

// The same of textures' indices: a record that is not read has none.
uvec4 loadTextureRow(const uint i, const uint row, const bool isUsed) {
    return isUsed ? LOAD4(materialWords, i * kMaterialRows + row) : uvec4(kNoTextureRecord);
}

MaterialRecord loadMaterial(const uint i) {
    const bool isPainted = hasFeature(kFeatureTextures);
    const vec4 base = uintBitsToFloat(loadMaterialRow(i, 0u, true));
    const vec4 emission = uintBitsToFloat(loadMaterialRow(i, 1u, hasFeature(kFeatureEmission)));
    const uvec4 plain = loadMaterialRow(i, 2u, true);
    const uvec4 textures = loadTextureRow(i, 3u, isPainted);
    const vec4 more = uintBitsToFloat(loadMaterialRow(
        i, 4u, hasFeature(kFeatureNormalMaps | kFeatureAlpha | kFeatureTransmission | kFeatureDispersion)));
    const uvec4 volume = loadMaterialRow(i, 5u, hasFeature(kFeatureTransmission));
    const vec4 specular = uintBitsToFloat(loadMaterialRow(i, 6u, hasFeature(kFeatureSpecular)));
    const vec4 sheen = uintBitsToFloat(loadMaterialRow(i, 7u, hasFeature(kFeatureSheen)));
    const bool isTranslucent = hasFeature(kFeatureDiffuseTransmission);
    const vec4 translucent = uintBitsToFloat(loadMaterialRow(i, 8u, isTranslucent));
    const vec4 coat = uintBitsToFloat(loadMaterialRow(i, 9u, hasFeature(kFeatureCoat | kFeatureAnisotropy)));
    const vec4 film = uintBitsToFloat(loadMaterialRow(i, 10u, hasFeature(kFeatureIridescence)));
    const uvec4 turn =
        loadMaterialRow(i, 11u, hasFeature(kFeatureAnisotropy) || (isPainted && isTranslucent));
    const uvec4 textures2 = loadTextureRow(i, 12u, isPainted && hasFeature(kFeatureSpecular | kFeatureSheen));
    const uvec4 textures3 =
        loadTextureRow(i, 13u, isPainted && hasFeature(kFeatureCoat | kFeatureAnisotropy));
    const uvec4 textures4 = loadTextureRow(i, 14u, isPainted && hasFeature(kFeatureIridescence));
    return MaterialRecord(base.xyz, base.w, emission.xyz, emission.w, uintBitsToFloat(plain.x),
                          uintBitsToFloat(plain.y), uintBitsToFloat(plain.z), plain.w, textures.x, textures.y,
                          textures.z, textures.w, more.x, more.y, more.z, more.w, uintBitsToFloat(volume.xyz),
                          volume.w, specular.xyz, specular.w, sheen.xyz, sheen.w, translucent.xyz,
                          translucent.w, coat.x, coat.y, coat.z, coat.w, film.x, film.y, film.z, film.w,
                          uintBitsToFloat(turn.x), uintBitsToFloat(turn.y), turn.z, turn.w, textures2.x,
                          textures2.y, textures2.z, textures2.w, textures3.x, textures3.y, textures3.z,
                          textures3.w, textures4.x, textures4.y, 0u, 0u);
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
    return Emitter(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), 0u);
}

LightRecord loadLight(const uint i) {
    const uvec4 a = LOAD4(lightWords, 3u * i);
    const vec4 b = uintBitsToFloat(LOAD4(lightWords, 3u * i + 1u));
    const vec4 c = uintBitsToFloat(LOAD4(lightWords, 3u * i + 2u));
    return LightRecord(uintBitsToFloat(a.xyz), a.w, b.xyz, b.w, c.xyz, c.w);
}

TableEntry loadTableEntry(const uint i) {
    const uvec4 words = LOAD4(tableWords, i);
    return TableEntry(uintBitsToFloat(words.x), uintBitsToFloat(words.y), uintBitsToFloat(words.z), words.w);
}
vec3 loadEnvironment(const uint i) { return uintBitsToFloat(LOAD4(environmentWords, i).xyz); }
#endif
