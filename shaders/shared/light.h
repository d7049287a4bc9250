// SPDX-License-Identifier: MIT
// Samples lights, and points and directions on them.
#ifndef METAMARCH_SHARED_LIGHT_H
#define METAMARCH_SHARED_LIGHT_H
#include "math.h"

SHARED_BEGIN

// Returns the weight of a sample drawn with density `own` that another technique draws with density `other`.
// E. Veach, L. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995.
SHARED_FN float powerHeuristic(const float own, const float other) {
    const float ratio = min(other / max(own, 1e-30f), 1e18f);
    return 1.0f / (1.0f + ratio * ratio);
}

// The same, for a technique whose density was made for this weight: see weighted_table.cpp.
SHARED_FN float balanceHeuristic(const float own, const float other) {
    return 1.0f / (1.0f + min(other / max(own, 1e-30f), 1e18f));
}

// One entry of a table that samples a discrete distribution by inverting its cumulative distribution, which
// preserves the stratification of u. The search starts at the guide: H. Chen, Y. Asau, "On Generating Random
// Variates from an Empirical Distribution", AIIE Transactions 6(2), 1974.
struct TableEntry {
    float from; // the entry is drawn for u in [from, upTo)
    float upTo;
    float probability;
    uint guide; // the first entry that any u in this entry's guide slot can draw; slots have equal width
};

struct TableChoice {
    uint index;
    float probability;
    float uRemapped; // in [0, 1): u rescaled within the entry, as good as a new random number
    bool isWhole;    // false if the driver has ended the search early: see `finish` in lib/scene.glsl
};

SHARED_FN uint guideSlot(const float u, const uint count) { return min(uint(u * float(count)), count - 1u); }

SHARED_FN TableChoice chosenEntry(const TableEntry entry, const uint index, const float u) {
    const float uRemapped = (u - entry.from) / (entry.upTo - entry.from);
    return TableChoice(index, entry.probability, min(max(uRemapped, 0.0f), 0.99999994f), true);
}

// Returns a number in [0, 1] with a density that goes linearly from `atStart` at 0 to `atEnd` at 1. Both are
// at least 0, and their squares are finite; u is in [0, 1).
SHARED_FN float sampleLinear(const float atStart, const float atEnd, const float u) {
    const float density = sqrt(blend(atStart * atStart, atEnd * atEnd, u)); // at the result
    const float twiceMean = atStart + density;
    return twiceMean > 0.0f ? min(u * (atStart + atEnd) / twiceMean, 1.0f) : u;
}

// Returns the barycentric weights of a point that is uniform in the triangle's area. E. Heitz, "A
// Low-Distortion Map Between Triangle and Square", 2019.
SHARED_FN vec3 sampleTriangle(const vec2 u) {
    const bool isUpper = u.y > u.x;
    const float lesser = (isUpper ? u.x : u.y) * 0.5f;
    const float greater = (isUpper ? u.y : u.x) - lesser;
    const float x = isUpper ? lesser : greater;
    const float y = isUpper ? greater : lesser;
    return vec3(x, y, max(1.0f - x - y, 0.0f));
}

// Converts a density over area to one over solid angle. `cosine` is that of the angle between the surface
// normal and the direction. Returns 0 if the surface is seen edge-on.
SHARED_FN float solidAngleDensity(const float areaDensity, const float squaredDistance, const float cosine) {
    return abs(cosine) > 0.0f ? areaDensity * squaredDistance / abs(cosine) : 0.0f;
}

// Values of LightRecord::kind.
const uint kLightDirectional = 0u;
const uint kLightPoint = 1u;
const uint kLightSpot = 2u;
const uint kLightDisc = 3u; // the sun: so far away that every point sees the same disc

// A light that rays cannot hit, or the sun. KHR_lights_punctual in radiometric units: candela and lux are
// taken as W/sr and W/m^2.
struct LightRecord {
    vec3 position; // point and spot only
    uint kind;
    // Unit length; towards a directional light or disc, but the direction in which a spot shines.
    vec3 direction;
    float scale;   // spot: see makeSpotFalloff; disc: 1 - cosine of the angular radius
    vec3 strength; // directional: irradiance; point and spot: intensity; disc: radiance
    float offset;  // spot only: see makeSpotFalloff
};

// Returns (scale, offset) of the falloff between a spot's cones. The host computes the cosines, once for both
// sides.
SHARED_FN vec2 makeSpotFalloff(const float innerCosine, const float outerCosine) {
    const float scale = 1.0f / max(innerCosine - outerCosine, 0.001f);
    return vec2(scale, -outerCosine * scale);
}

struct LightSample {
    vec3 wi;        // unit length
    float distance; // kFarLight: infinitely far
    vec3 arriving;  // times BSDF and |cosine|: the light's contribution to the radiance towards wo
    float pdf;      // per solid angle; 0 if only light sampling can find the light
    bool isWhole;   // as in TableChoice
};

const float kFarLight = 3.0e38f;

// Returns a direction in the cone around z, uniform in solid angle; `size` is 1 - cosine of its half angle.
SHARED_FN vec3 sampleCone(const float size, const vec2 u) {
    const float below = u.y * size; // 1 - cosine; exact for small cones too
    const float radius = sqrt(max(below * (2.0f - below), 0.0f));
    const vec2 circle = circlePoint(u.x);
    return vec3(circle.x * radius, circle.y * radius, 1.0f - below);
}

SHARED_FN LightSample sampleLight(const LightRecord light, const vec3 point, const vec2 u) {
    const bool isFar = light.kind == kLightDirectional || light.kind == kLightDisc;
    const bool isDisc = light.kind == kLightDisc;
    const vec3 towards = light.position - point;
    const float squaredDistance = max(dotProduct(towards, towards), 1e-20f);
    const float distance = sqrt(squaredDistance);

    const Basis around = basisAround(light.direction);
    const vec3 onDisc = sampleCone(light.scale, u);
    const vec3 toDisc =
        unitVector(around.tangent * onDisc.x + around.bitangent * onDisc.y + light.direction * onDisc.z);
    const vec3 wi = isDisc ? toDisc : isFar ? light.direction : towards / distance;

    const float cone = min(max(-dotProduct(wi, light.direction) * light.scale + light.offset, 0.0f), 1.0f);
    const float falloff = light.kind == kLightSpot ? cone * cone : 1.0f;
    const float discAngle = kTwoPi * light.scale; // steradians
    const float amount = isDisc ? discAngle : isFar ? 1.0f : falloff / squaredDistance;
    return LightSample(wi, isFar ? kFarLight : distance, light.strength * amount,
                       isDisc ? 1.0f / discAngle : 0.0f, true);
}

// Returns true if a ray that leaves the scene in direction `wi` sees the disc.
SHARED_FN bool hitsDisc(const LightRecord light, const vec3 wi) {
    const vec3 off = wi - light.direction; // its square is 2 * (1 - cosine), without cancellation
    return light.kind == kLightDisc && dotProduct(off, off) <= 2.0f * light.scale;
}

SHARED_ASSERT_SIZE(TableEntry, 16)
SHARED_ASSERT_OFFSET(TableEntry, upTo, 4)
SHARED_ASSERT_OFFSET(TableEntry, probability, 8)
SHARED_ASSERT_OFFSET(TableEntry, guide, 12)
SHARED_ASSERT_SIZE(LightRecord, 48)
SHARED_ASSERT_OFFSET(LightRecord, kind, 12)
SHARED_ASSERT_OFFSET(LightRecord, direction, 16)
SHARED_ASSERT_OFFSET(LightRecord, scale, 28)
SHARED_ASSERT_OFFSET(LightRecord, strength, 32)
SHARED_ASSERT_OFFSET(LightRecord, offset, 44)

SHARED_END
#endif
