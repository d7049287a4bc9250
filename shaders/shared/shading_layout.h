// SPDX-License-Identifier: MIT
// The layout of the buffers that the path tracer reads: surfaces, materials, textures, lights.
#ifndef METAMARCH_SHARED_SHADING_LAYOUT_H
#define METAMARCH_SHARED_SHADING_LAYOUT_H
#include "interop.h"

// The estimator is written once and reads the scene through functions named load…. In GLSL they read the
// bound buffers (lib/shading.glsl), in C++ a ShadingScene that is passed as the first argument.
#ifdef __cplusplus
#define SCENE_PARAMETER const ShadingScene &scene,
#define SCENE scene,
#else
#define SCENE_PARAMETER
#define SCENE
#endif

SHARED_BEGIN

// Binding numbers (set 0), in addition to those of scene_layout.h.
const uint kBindSurfaces = 30u;
const uint kBindVertices = 31u;
const uint kBindColors = 32u;
const uint kBindTangents = 33u;
const uint kBindMaterialRecords = 34u;
const uint kBindTextures = 35u;
const uint kBindEmitters = 36u;
const uint kBindLights = 37u;
const uint kBindTables = 38u; // TableEntry
const uint kBindEnvironment = 39u;
const uint kBindTexels = 40u; // the first of kTexelChunks bindings

// Texels are the second large array of a scene. Like the triangle records, they are cut into chunks; each
// image is in one chunk.
const uint kTexelChunks = 4u;

const uint kSpecFeatures = 3u; // specialization constant: bits of features.h

// A triangle's indices into the arrays of vertices and materials.
struct Surface {
    uint vertex0;
    uint vertex1;
    uint vertex2;
    uint material;
};

struct Vertex {
    vec3 normal; // zero: use the triangle's geometric normal
    float u0;    // two sets of texture coordinates
    float v0;
    float u1;
    float v1;
    uint further; // with kFeatureFurtherSets, the vertex that holds the third and the fourth set
};

const uint kNoTextureRecord = 0xffffffffu;

// Bits of MaterialRecord::flags, in addition to those of SurfaceMaterial::flags.
const uint kMaterialDoubleSided = 4u; // emits on both sides
const uint kMaterialUnlit = 8u;
const uint kMaterialMask = 16u;
const uint kMaterialBlend = 32u;

// The factors and textures of a Material (src/scene/material.h); material_rows.inc lists them.
struct MaterialRecord {
#define PARAMETER(type, name, value) type name;
#define TEXTURE(name, value) uint name;
#include "material_rows.inc"
};

// The number of rows in a MaterialRecord; a row has four words.
// NOLINTBEGIN(bugprone-macro-parentheses): the terms of a sum
#define MATERIAL_ROW(condition, X, Y, Z, W) +1u
#define MATERIAL_VECTOR_ROW(condition, XYZ, W) +1u
// NOLINTEND(bugprone-macro-parentheses)
const uint kMaterialRows = 0u
#include "material_rows.inc"
    ;

// Bits of TextureUse::flags.
const uint kTextureWrapMask = 3u; // the wrap mode of s is in bits 0 and 1, that of t in bits 2 and 3
const uint kTextureWrapTShift = 2u;
const uint kWrapRepeat = 0u;
const uint kWrapMirror = 1u;
const uint kWrapClamp = 2u;
const uint kTextureNearest = 16u;         // nearest filter when magnified; otherwise bilinear
const uint kTextureMinifiedNearest = 32u; // nearest filter when minified; otherwise bilinear
const uint kTextureBetweenLevels = 64u;   // when minified, blend two levels; otherwise use the nearest level
const uint kTextureSecondSet = 128u;      // use the second set of texture coordinates, or the fourth
const uint kTextureFurtherSet = 256u;     // use the third or the fourth set of texture coordinates
const uint kTextureLastLevelShift = 9u;   // of the coarsest level; it is 0 if there is only the full size

// One use of a texture by a material.
struct TextureUse {
    vec3 rowU;       // row of KHR_texture_transform's matrix: the new u is dot(rowU, (u, v, 1))
    float unitLevel; // log2 of the number of texels along the side of a unit square of texture coordinates
    vec3 rowV;
    uint flags;
};

// Bits of TextureLevel::format.
const uint kTexelsSrgb = 1u;
const uint kTexelsDeep = 2u; // a texel has two words of half floats; otherwise one word of bytes
const uint kTexelsChunkShift = 2u;

// The texels of one level of a texture. Level 0 is the full size; each further level has half the size of the
// one before.
struct TextureLevel {
    uint firstWord; // index in its chunk
    uint width;
    uint height;
    uint format;
};

// A use of a texture and its level 0. Level l is in the l-th record after it; the `use` of that record is
// unused.
struct TextureRecord {
    TextureLevel level;
    TextureUse use;
};

// A triangle that light sampling can choose.
struct Emitter {
    vec3 v0;
    uint triangleId;
    vec3 v1;
    uint material;
    vec3 v2;
    uint branches; // with kFeatureLightTree, the way from the root: bit i is 1 for the second child of i-th
                   // node
};

SHARED_ASSERT_SIZE(Surface, 16)
SHARED_ASSERT_OFFSET(Surface, material, 12)
SHARED_ASSERT_SIZE(Vertex, 32)
SHARED_ASSERT_OFFSET(Vertex, u0, 12)
SHARED_ASSERT_OFFSET(Vertex, v0, 16)
SHARED_ASSERT_SIZE(MaterialRecord, std::size_t{16} * kMaterialRows)
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
