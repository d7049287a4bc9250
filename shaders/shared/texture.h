// SPDX-License-Identifier: MIT
// Texture look-up: transform, wrap modes, mip levels, nearest or bilinear filter, sRGB decoding.
#ifndef METAMARCH_SHARED_TEXTURE_H
#define METAMARCH_SHARED_TEXTURE_H
#include "features.h"
#include "math.h"
#include "shading_layout.h"

#ifdef __cplusplus
#include "shading_scene.h"

#include <glm/packing.hpp>
namespace metamarch {
using glm::unpackHalf2x16;
}
#endif

SHARED_BEGIN

// IEC 61966-2-1, by a polynomial that is within 1e-4 of the result. A table would cost four loads per
// look-up, and the drivers' pow() differs between devices.
SHARED_FN vec3 srgbToLinear(const vec3 c) {
    const vec3 high =
        ((((((c * 0.1248841f - vec3(0.483246378f)) * c + vec3(0.80917798f)) * c - vec3(0.833380126f)) * c +
           vec3(0.86182534f)) *
              c +
          vec3(0.484530878f)) *
             c +
         vec3(0.0354002804f)) *
            c +
        vec3(0.000851744481f);
    const vec3 low = c * 0.0773993808f;
    return min(vec3(c.x > 0.04045f ? high.x : low.x, c.y > 0.04045f ? high.y : low.y,
                    c.z > 0.04045f ? high.z : low.z),
               vec3(1.0f));
}

// Applies the wrap mode to a texel coordinate `i` from -size to 2 size.
SHARED_FN int wrapped(const int i, const int size, const uint wrap) {
    const int folded = i < 0 ? -1 - i : i >= size ? 2 * size - 1 - i : i;
    const int moved = i < 0 ? i + size : i >= size ? i - size : i;
    const int inside = wrap == kWrapMirror ? folded : moved;
    return wrap == kWrapClamp ? min(max(i, 0), size - 1) : inside;
}

// A texture transform of a file may overflow: 1e38 * 10 - 1e38 * 10 is NaN. What is farther than this counts
// as 0, and so does NaN, because neither converts to the index of a texel.
const float kFarthestTexture = 1e30f;

// Maps a coordinate to [0, 1], where the whole image is one unit wide; mirrored coordinates are folded.
SHARED_FN float withinPeriod(const float coordinate, const uint wrap) {
    const float u = abs(coordinate) < kFarthestTexture ? coordinate : 0.0f;
    const float once = u - floor(u);
    const float periods = u * 0.5f;
    const float twice = (periods - floor(periods)) * 2.0f;
    const float mirrored = twice > 1.0f ? 2.0f - twice : twice;
    const float clamped = min(max(u, 0.0f), 1.0f);
    return wrap == kWrapRepeat ? once : wrap == kWrapMirror ? mirrored : clamped;
}

// Returns one texel as rgba, decoded to linear light.
SHARED_FN vec4 texelAt(SCENE_PARAMETER const TextureLevel level, const int x, const int y) {
    const uint index = uint(y) * level.width + uint(x);
    const uint chunk = level.format >> kTexelsChunkShift;
    if (hasFeature(SCENE kFeatureDeepTextures) && (level.format & kTexelsDeep) != 0u) {
        const uint word = level.firstWord + 2u * index;
        const vec2 rg = unpackHalf2x16(loadTexel(SCENE chunk, word));
        const vec2 ba = unpackHalf2x16(loadTexel(SCENE chunk, word + 1u));
        const vec3 color = vec3(rg.x, rg.y, ba.x);
        const vec3 linear = (level.format & kTexelsSrgb) != 0u ? srgbToLinear(color) : color;
        return vec4(linear, ba.y);
    }
    const uint word = loadTexel(SCENE chunk, level.firstWord + index);
    const vec3 color =
        vec3(float(word & 255u), float((word >> 8u) & 255u), float((word >> 16u) & 255u)) / 255.0f;
    const vec3 linear = (level.format & kTexelsSrgb) != 0u ? srgbToLinear(color) : color;
    return vec4(linear, float(word >> 24u) / 255.0f);
}

// The place at which a surface looks up its textures: sets of texture coordinates, and the footprint in each.
// The third and the fourth count with kFeatureFurtherSets.
struct TexturePoint {
    vec2 first;
    vec2 second;
    vec2 third;
    vec2 fourth;
    float firstLevel; // log2 of the side of the footprint, taken as a square; kFinestLevel: a point
    float secondLevel;
    float thirdLevel;
    float fourthLevel;
    float uLevel; // random number in [0, 1) that chooses between two levels
};
const float kFinestLevel = -1000.0f;

// Returns the level for a footprint with a side of 2^`texels` texels. One of two levels is chosen at random,
// so that their mean is the blend of both at the cost of one look-up.
SHARED_FN uint chosenLevel(const uint flags, const float texels, const float u) {
    const float last = float(flags >> kTextureLastLevelShift);
    const float part = (flags & kTextureBetweenLevels) != 0u ? u : 0.5f;
    const float level = floor(texels + part);
    return level > 0.0f ? uint(min(level, last)) : 0u; // a NaN converts to no integer
}

// Returns 1 in every channel for kNoTextureRecord.
SHARED_FN vec4 lookUp(SCENE_PARAMETER const uint textureId, const TexturePoint at) {
    if (!hasFeature(SCENE kFeatureTextures) || textureId == kNoTextureRecord) {
        return vec4(1.0f);
    }
    const TextureUse use = loadTextureUse(SCENE textureId);
    const bool isSecond = (use.flags & kTextureSecondSet) != 0u;
    const bool isFurther = hasFeature(SCENE kFeatureFurtherSets) && (use.flags & kTextureFurtherSet) != 0u;
    const vec2 uv = isFurther ? (isSecond ? at.fourth : at.third) : (isSecond ? at.second : at.first);
    const float u = use.rowU.x * uv.x + use.rowU.y * uv.y + use.rowU.z;
    const float v = use.rowV.x * uv.x + use.rowV.y * uv.y + use.rowV.z;
    const uint wrapS = use.flags & kTextureWrapMask;
    const uint wrapT = (use.flags >> kTextureWrapTShift) & kTextureWrapMask;
    uint levelId = textureId;
    bool isNearest = (use.flags & kTextureNearest) != 0u;
    if (hasFeature(SCENE kFeatureMipmaps)) {
        const float level = isFurther ? (isSecond ? at.fourthLevel : at.thirdLevel)
                                      : (isSecond ? at.secondLevel : at.firstLevel);
        const float texels = use.unitLevel + level;
        levelId = textureId + chosenLevel(use.flags, texels, at.uLevel);
        isNearest = (use.flags & (texels > 0.0f ? kTextureMinifiedNearest : kTextureNearest)) != 0u;
    }
    const TextureLevel level = loadTextureLevel(SCENE levelId);
    const int width = int(level.width);
    const int height = int(level.height);
    const float shift = isNearest ? 0.0f : 0.5f;
    const float x = withinPeriod(u, wrapS) * float(width) - shift;
    const float y = withinPeriod(v, wrapT) * float(height) - shift;
    const float left = floor(x);
    const float top = floor(y);
    const float right = isNearest ? 0.0f : x - left;
    const float down = isNearest ? 0.0f : y - top;
    const int x0 = wrapped(int(left), width, wrapS);
    const int x1 = wrapped(int(left) + 1, width, wrapS);
    const int y0 = wrapped(int(top), height, wrapT);
    const int y1 = wrapped(int(top) + 1, height, wrapT);
    const vec4 upper = texelAt(SCENE level, x0, y0) * (1.0f - right) + texelAt(SCENE level, x1, y0) * right;
    const vec4 lower = texelAt(SCENE level, x0, y1) * (1.0f - right) + texelAt(SCENE level, x1, y1) * right;
    return upper * (1.0f - down) + lower * down;
}

SHARED_END
#endif
