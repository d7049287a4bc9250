// SPDX-License-Identifier: MIT
// What shading reads of a scene, as both sides see it: surfaces, materials, textures, lights.
#ifndef METAMARCH_SHARED_SHADING_LAYOUT_H
#define METAMARCH_SHARED_SHADING_LAYOUT_H
#include "interop.h"

// The estimator is written once and reads the scene through functions named load…: in GLSL they read the
// bound buffers (lib/shading.glsl), in C++ a ShadingScene that is handed on as the first argument.
#ifdef __cplusplus
#define SCENE_PARAMETER const ShadingScene &scene,
#define SCENE scene,
#else
#define SCENE_PARAMETER
#define SCENE
#endif

SHARED_BEGIN

// Binding numbers (set 0) beside those of scene_layout.h.
const uint kBindSurfaces = 30u;
const uint kBindVertices = 31u;
const uint kBindColors = 32u;
const uint kBindTangents = 33u;
const uint kBindMaterialRecords = 34u;
const uint kBindTextures = 35u;
const uint kBindEmitters = 36u;
const uint kBindLights = 37u;
const uint kBindTables = 38u; // of TableEntries
const uint kBindEnvironment = 39u;
const uint kBindTexels = 40u; // the first of kTexelChunks bindings

// Texels are the second large array of a scene, cut as the triangle records are. No image crosses a cut.
const uint kTexelChunks = 4u;

const uint kSpecFeatures = 3u; // specialization constant: bits of features.h

// What a triangle is beside its corners: indices into the vertex arrays and the materials.
struct Surface {
    uint vertex0;
    uint vertex1;
    uint vertex2;
    uint material;
};

struct Vertex {
    vec3 normal; // zero: the triangle's own counts
    float u0;    // texture coordinates, two sets
    float v0;
    float u1;
    float v1;
    uint padding;
};

const uint kNoTextureRecord = 0xffffffffu;

// MaterialRecord::flags, beside those of SurfaceMaterial.
const uint kMaterialDoubleSided = 4u; // emits to both sides
const uint kMaterialUnlit = 8u;
const uint kMaterialMask = 16u;
const uint kMaterialBlend = 32u;

// Factors and textures of a Material (src/scene/material.h), as material_rows.inc lists them.
struct MaterialRecord {
#define PARAMETER(type, name, value) type name;
#define TEXTURE(name, value) uint name;
#include "material_rows.inc"
};

// In a MaterialRecord, of four words each.
#define MATERIAL_ROW(condition, X, Y, Z, W) +1u
#define MATERIAL_VECTOR_ROW(condition, XYZ, W) +1u
const uint kMaterialRows = 0u
#include "material_rows.inc"
    ;

// TextureRecord::flags.
const uint kTextureWrapMask = 3u; // of s in bits 0 and 1, of t in bits 2 and 3
const uint kTextureWrapTShift = 2u;
const uint kWrapRepeat = 0u;
const uint kWrapMirror = 1u;
const uint kWrapClamp = 2u;
const uint kTextureNearest = 16u;         // where it is magnified; else bilinear
const uint kTextureMinifiedNearest = 32u; // where it is minified
const uint kTextureBetweenLevels = 64u;   // minified: of the two nearest levels in part; else of the nearest
const uint kTextureSecondSet = 128u;      // of texture coordinates
const uint kTextureLastLevelShift = 8u;   // the coarsest level; 0: there is but the full-size one

// One use of a texture by a material.
struct TextureUse {
    vec3 rowU;       // of KHR_texture_transform: dot(rowU, (u, v, 1))
    float unitLevel; // log2 of the texels along the side of a unit square of texture coordinates
    vec3 rowV;
    uint flags;
};

// TextureLevel::format.
const uint kTexelsSrgb = 1u;
const uint kTexelsDeep = 2u; // two words a texel, of halves; else one, of bytes
const uint kTexelsChunkShift = 2u;

// The texels of one level of a texture, of which 0 is the full size and each further one half of the last.
struct TextureLevel {
    uint firstWord; // in its chunk
    uint width;
    uint height;
    uint format;
};

// A use and its level 0. Level l is in the l-th record after it, whose `use` says nothing.
struct TextureRecord {
    TextureLevel level;
    TextureUse use;
};

// A triangle that light sampling knows.
struct Emitter {
    vec3 v0;
    uint triangleId;
    vec3 v1;
    uint material;
    vec3 v2;
    uint padding;
};

SHARED_ASSERT_SIZE(Surface, 16)
SHARED_ASSERT_OFFSET(Surface, material, 12)
SHARED_ASSERT_SIZE(Vertex, 32)
SHARED_ASSERT_OFFSET(Vertex, u0, 12)
SHARED_ASSERT_OFFSET(Vertex, v0, 16)
SHARED_ASSERT_SIZE(MaterialRecord, 16 * kMaterialRows)
SHARED_ASSERT_SIZE(TextureUse, 32)
SHARED_ASSERT_OFFSET(TextureUse, unitLevel, 12)
SHARED_ASSERT_OFFSET(TextureUse, rowV, 16)
SHARED_ASSERT_OFFSET(TextureUse, flags, 28)
SHARED_ASSERT_SIZE(TextureLevel, 16)
SHARED_ASSERT_OFFSET(TextureLevel, height, 8)
SHARED_ASSERT_OFFSET(TextureLevel, format, 12)
SHARED_ASSERT_SIZE(TextureRecord, 48)
SHARED_ASSERT_OFFSET(TextureRecord, use, 16)
SHARED_ASSERT_SIZE(Emitter, 48)
SHARED_ASSERT_OFFSET(Emitter, v1, 16)
SHARED_ASSERT_OFFSET(Emitter, v2, 32)

SHARED_END
#endif
