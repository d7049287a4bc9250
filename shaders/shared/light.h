// Choosing among lights, and points and directions on them.
#ifndef METAMARCH_SHARED_LIGHT_H
#define METAMARCH_SHARED_LIGHT_H
#include "math.h"

SHARED_BEGIN

// The weight of a sample drawn with density `own` where another way draws it with density `other`.
// E. Veach, L. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995.
SHARED_FN float powerHeuristic(const float own, const float other) {
    const float ratio = min(other / max(own, 1e-30f), 1e18f);
    return 1.0f / (1.0f + ratio * ratio);
}

// One entry of a table that draws by weight, by the inverse of the cumulative distribution: what is
// stratified in u stays stratified in what is drawn. The search starts at the guide: H. Chen, Y. Asau, "On
// Generating Random Variates from an Empirical Distribution", AIIE Transactions 6(2), 1974.
struct TableEntry {
    float from; // it is drawn for u in [from, upTo)
    float upTo;
    float probability;
    uint guide; // the first entry that any u of the guide's own slot can draw; slots are of equal width
};

struct TableChoice {
    uint index;
    float probability;
    float rest; // in [0, 1): what of u is left, a number as good as new
};

SHARED_FN uint guideSlot(const float u, const uint count) { return min(uint(u * float(count)), count - 1u); }

SHARED_FN TableChoice chosenEntry(const TableEntry entry, const uint index, const float u) {
    const float rest = (u - entry.from) / (entry.upTo - entry.from);
    return TableChoice(index, entry.probability, min(max(rest, 0.0f), 0.99999994f));
}

// Weights of the three corners for a point of the triangle, uniform in its area.
// E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
SHARED_FN vec3 sampleTriangle(const vec2 u) {
    const bool isUpper = u.y > u.x;
    const float lesser = (isUpper ? u.x : u.y) * 0.5f;
    const float rest = (isUpper ? u.y : u.x) - lesser;
    const float x = isUpper ? lesser : rest;
    const float y = isUpper ? rest : lesser;
    return vec3(x, y, max(1.0f - x - y, 0.0f));
}

// A density over area as one over solid angle, where the surface is seen at that distance and its normal has
// the cosine to the direction. 0 where it is seen edge-on.
SHARED_FN float solidAngleDensity(const float areaDensity, const float squaredDistance, const float cosine) {
    return abs(cosine) > 0.0f ? areaDensity * squaredDistance / abs(cosine) : 0.0f;
}

// LightRecord::kind.
const uint kLightDirectional = 0u;
const uint kLightPoint = 1u;
const uint kLightSpot = 2u;
const uint kLightDisc = 3u; // the sun: so far away that every point sees the same disc

// A light that rays cannot hit, or that is as large as the sun. KHR_lights_punctual in watts: candela and lux
// are taken as W/sr and W/m^2.
struct LightRecord {
    vec3 position; // of a point or spot
    uint kind;
    vec3 direction; // from which a directional light or a disc shines, where a spot shines to; of unit length
    float scale;    // spot: see makeSpotFalloff; disc: 1 - cosine of its angular radius
    vec3 strength;  // directional: irradiance; point and spot: intensity; disc: radiance
    float offset;   // spot
};

// (scale, offset) of the falloff between the cones. The cosines are the host's, once for both sides.
SHARED_FN vec2 makeSpotFalloff(const float innerCosine, const float outerCosine) {
    const float scale = 1.0f / max(innerCosine - outerCosine, 0.001f);
    return vec2(scale, -outerCosine * scale);
}

struct LightSample {
    vec3 wi;        // of unit length
    float distance; // kFarLight: no end
    vec3 arriving;  // times BSDF and |cosine|: what wo sees of it
    float pdf;      // per solid angle; 0: only light sampling finds it
};

const float kFarLight = 3.0e38f;

// A direction of the cone around z, uniform in solid angle; `size` is 1 - cosine of its half angle.
SHARED_FN vec3 sampleCone(const float size, const vec2 u) {
    const float below = u.y * size; // 1 - cosine, exact also for small cones
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
                       isDisc ? 1.0f / discAngle : 0.0f);
}

// What a ray that leaves the scene in direction `wi` sees of a disc.
SHARED_FN bool hitsDisc(const LightRecord light, const vec3 wi) {
    const vec3 off = wi - light.direction; // its square is 2 * (1 - cosine), with all its bits
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
