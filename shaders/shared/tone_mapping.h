// SPDX-License-Identifier: MIT
// Maps a scene's radiance to a screen's.
#ifndef METAMARCH_SHARED_TONE_MAPPING_H
#define METAMARCH_SHARED_TONE_MAPPING_H
#include "math.h"

SHARED_BEGIN

// The tone operators; each treats all pixels alike. Values that a screen cannot show are
//   none     clipped at 1 in each channel.
//   neutral  compressed, and desaturated with growing brightness. A colour up to about 0.8 is unchanged
//            except for the 0.04 that a dielectric reflects. Khronos PBR Neutral Tone Mapper, 2024: the
//            colours of materials on the screen are those of their textures.
//   aces     as on film: S. Hill's fit of the ACES reference rendering and sRGB output transforms
//            (M. Pettineo, BakingLab, ACES.hlsl, 2016), without its own exposure.
//   agx      as on film that desaturates bright light: T. Sobotka's AgX, with B. Wrensch's fit of the base
//            contrast ("Minimal AgX Implementation", 2023), whose 2.2 power is undone.
const uint kToneNone = 0u;
const uint kToneNeutral = 1u;
const uint kToneAces = 2u;
const uint kToneAgx = 3u;

// Maps to white under every operator; its square is finite.
const float kBrightest = 1.0e10f;

SHARED_FN vec3 clampedColor(const vec3 color) { return min(max(color, vec3(0.0f)), vec3(1.0f)); }

// Multiplies by the matrix with these rows.
SHARED_FN vec3 mixedChannels(const vec3 color, const vec3 red, const vec3 green, const vec3 blue) {
    return vec3(dotProduct(red, color), dotProduct(green, color), dotProduct(blue, color));
}

SHARED_FN vec3 neutralTone(const vec3 color) {
    const float reflected = 0.04f;        // reflectance of a dielectric at normal incidence
    const float compressionStart = 0.76f; // 0.8 minus that
    const float desaturation = 0.15f;
    const float least = smallest(color);
    // The offset is smaller where little light can have been reflected; both formulas meet at 0.08 with the
    // same slope.
    const float offset = least < 0.08f ? least - least * least / 0.16f : reflected;
    const vec3 base = color - vec3(offset);
    const float peak = largest(base);
    if (peak < compressionStart) {
        return base;
    }
    // 0.0576 is the square of 0.24, the distance from compressionStart to 1.
    const float newPeak = 1.0f - 0.0576f / (peak - 0.52f);
    const float whiteness = 1.0f - 1.0f / (desaturation * (peak - newPeak) + 1.0f);
    return blend3(base * (newPeak / peak), vec3(newPeak), whiteness);
}

SHARED_FN vec3 acesTone(const vec3 color) {
    // Converts sRGB to ACEScg and applies the reference rendering transform's desaturation.
    const vec3 v = mixedChannels(color, vec3(0.59719f, 0.35458f, 0.04823f),
                                 vec3(0.07600f, 0.90834f, 0.01566f), vec3(0.02840f, 0.13383f, 0.83777f));
    const vec3 fitted = (v * (v + vec3(0.0245786f)) - vec3(0.000090537f)) /
                        (v * (v * 0.983729f + vec3(0.4329510f)) + vec3(0.238081f));
    // Applies the output transform's desaturation and converts back to sRGB.
    return mixedChannels(fitted, vec3(1.60475f, -0.53108f, -0.07367f), vec3(-0.10208f, 1.10813f, -0.00605f),
                         vec3(-0.00327f, -0.07276f, 1.07602f));
}

SHARED_FN float log2Of(const float x) { return logarithm(x) * 1.44269504089f; }

// x^exponent for x in [0, 1]; values below the smallest normal number count as 0.
SHARED_FN float powerOf(const float x, const float exponent) {
    return x < 1.17549435e-38f ? 0.0f : power(x, exponent);
}

SHARED_FN vec3 agxTone(const vec3 color) {
    const float darkest = -12.47393f; // stops
    const float range = 16.499999f;   // stops, up to 4.026069
    const vec3 inset = max(mixedChannels(color, vec3(0.842479062f, 0.0784336f, 0.0792237451f),
                                         vec3(0.0423282422f, 0.878468636f, 0.0791661275f),
                                         vec3(0.0423756549f, 0.0784336f, 0.879142974f)),
                           vec3(1e-10f));
    const vec3 stops = vec3(log2Of(inset.x), log2Of(inset.y), log2Of(inset.z));
    const vec3 x = clampedColor((stops - vec3(darkest)) / range);
    const vec3 x2 = x * x;
    const vec3 x4 = x2 * x2;
    const vec3 contrast = x4 * x2 * 15.5f - x4 * x * 40.14f + x4 * 31.96f - x2 * x * 6.868f + x2 * 0.4298f +
                          x * 0.1191f - vec3(0.00232f);
    const vec3 shown =
        clampedColor(mixedChannels(contrast, vec3(1.196879005f, -0.0980208811f, -0.0990297441f),
                                   vec3(-0.0528968518f, 1.15190313f, -0.0989611768f),
                                   vec3(-0.0529716355f, -0.0980434501f, 1.151073673f)));
    return vec3(powerOf(shown.x, 2.2f), powerOf(shown.y, 2.2f), powerOf(shown.z, 2.2f));
}

SHARED_FN float bounded(const float x) { return x > 0.0f ? min(x, kBrightest) : 0.0f; } // NaN becomes 0

// Maps linear Rec. 709 radiance, multiplied by `scale`, to linear Rec. 709 for the screen, with each channel
// in [0, 1]. Negative radiance and NaN count as 0, infinite radiance as kBrightest.
SHARED_FN vec3 toneMapped(const uint toneOperator, const float scale, const vec3 radiance) {
    const vec3 scaled = radiance * scale;
    const vec3 color = vec3(bounded(scaled.x), bounded(scaled.y), bounded(scaled.z));
    vec3 shown = color;
    if (toneOperator == kToneNeutral) {
        shown = neutralTone(color);
    } else if (toneOperator == kToneAces) {
        shown = acesTone(color);
    } else if (toneOperator == kToneAgx) {
        shown = agxTone(color);
    }
    return clampedColor(shown);
}

SHARED_END
#endif
