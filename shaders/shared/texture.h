// Looking a texture up: transform, wrap modes, nearest or bilinear filter, sRGB.
#ifndef METAMARCH_SHARED_TEXTURE_H
#define METAMARCH_SHARED_TEXTURE_H
#include "shared/features.h"
#include "shared/math.h"
#include "shared/shading_layout.h"

#ifdef __cplusplus
#include "scene/shading_scene.h"

#include <glm/packing.hpp>
namespace metamarch {
using glm::unpackHalf2x16;
}
#endif

SHARED_BEGIN

// IEC 61966-2-1 within 1e-4 of the result, by a polynomial: a table would cost four loads a look-up, and the
// drivers' pow is not the same everywhere.
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

// The texel that coordinate `i` (in texels, from -size to 2 size) shows.
SHARED_FN int wrapped(const int i, const int size, const uint wrap) {
    const int folded = i < 0 ? -1 - i : i >= size ? 2 * size - 1 - i : i;
    const int moved = i < 0 ? i + size : i >= size ? i - size : i;
    const int inside = wrap == kWrapMirror ? folded : moved;
    return wrap == kWrapClamp ? min(max(i, 0), size - 1) : inside;
}

// Brings a coordinate to [0, 1], with the whole picture one unit wide; mirrored ones by folding.
SHARED_FN float withinPeriod(const float u, const uint wrap) {
    const float once = u - floor(u);
    const float periods = u * 0.5f;
    const float twice = (periods - floor(periods)) * 2.0f;
    const float mirrored = twice > 1.0f ? 2.0f - twice : twice;
    const float clamped = min(max(u, 0.0f), 1.0f);
    return wrap == kWrapRepeat ? once : wrap == kWrapMirror ? mirrored : clamped;
}

// One texel, rgba, decoded to linear light.
SHARED_FN vec4 texelAt(SCENE_PARAMETER const TextureRecord record, const int x, const int y) {
    const uint index = uint(y) * record.width + uint(x);
    const uint chunk = record.flags >> kTextureChunkShift;
    if (hasFeature(SCENE kFeatureDeepTextures) && (record.flags & kTextureDeep) != 0u) {
        const uint word = record.firstWord + 2u * index;
        const vec2 rg = unpackHalf2x16(loadTexel(SCENE chunk, word));
        const vec2 ba = unpackHalf2x16(loadTexel(SCENE chunk, word + 1u));
        const vec3 color = vec3(rg.x, rg.y, ba.x);
        const vec3 linear = (record.flags & kTextureSrgb) != 0u ? srgbToLinear(color) : color;
        return vec4(linear, ba.y);
    }
    const uint word = loadTexel(SCENE chunk, record.firstWord + index);
    const vec3 color =
        vec3(float(word & 255u), float((word >> 8u) & 255u), float((word >> 16u) & 255u)) / 255.0f;
    const vec3 linear = (record.flags & kTextureSrgb) != 0u ? srgbToLinear(color) : color;
    return vec4(linear, float(word >> 24u) / 255.0f);
}

// Where a surface is looked up: two sets of texture coordinates.
struct TexturePoint {
    vec2 first;
    vec2 second;
};

// 1 in every channel for kNoTextureRecord.
SHARED_FN vec4 lookUp(SCENE_PARAMETER const uint textureId, const TexturePoint at) {
    if (!hasFeature(SCENE kFeatureTextures) || textureId == kNoTextureRecord) {
        return vec4(1.0f);
    }
    const TextureRecord record = loadTexture(SCENE textureId);
    const vec2 uv = (record.flags & kTextureSecondSet) != 0u ? at.second : at.first;
    const float u = record.rowU.x * uv.x + record.rowU.y * uv.y + record.rowU.z;
    const float v = record.rowV.x * uv.x + record.rowV.y * uv.y + record.rowV.z;
    const uint wrapS = record.flags & kTextureWrapMask;
    const uint wrapT = (record.flags >> kTextureWrapTShift) & kTextureWrapMask;
    const int width = int(record.width);
    const int height = int(record.height);
    const bool isNearest = (record.flags & kTextureNearest) != 0u;
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
    const vec4 upper = texelAt(SCENE record, x0, y0) * (1.0f - right) + texelAt(SCENE record, x1, y0) * right;
    const vec4 lower = texelAt(SCENE record, x0, y1) * (1.0f - right) + texelAt(SCENE record, x1, y1) * right;
    return upper * (1.0f - down) + lower * down;
}

SHARED_END
#endif
