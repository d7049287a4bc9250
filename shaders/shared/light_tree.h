// SPDX-License-Identifier: MIT
// A binary tree of lights. Light sampling walks it from the root to one light and takes the child that can
// give a point more light with a higher probability. A. Conty Estevez, C. Kulla, "Importance Sampling of Many
// Lights with Adaptive Tree Splitting", 2018; here without splitting: one light for one sample.
#ifndef METAMARCH_SHARED_LIGHT_TREE_H
#define METAMARCH_SHARED_LIGHT_TREE_H
#include "light.h"
#include "light_node.h"
#include "path_settings.h"
#include "shading_layout.h"
#ifdef __cplusplus
#include "shading_scene.h"
#endif

SHARED_BEGIN

// An angle in [0, pi].
struct Angle {
    float cosine;
    float sine;
};

SHARED_FN Angle angleOf(const float cosine) {
    const float limited = min(max(cosine, -1.0f), 1.0f);
    return Angle(limited, sqrt(max(1.0f - limited * limited, 0.0f)));
}

// Returns max(a - b, 0).
SHARED_FN Angle lessenedAngle(const Angle a, const Angle b) {
    const Angle difference =
        Angle(a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine);
    return a.cosine >= b.cosine ? Angle(1.0f, 0.0f) : difference;
}

// What light sampling needs to know of the surface that it samples light for.
struct LightReceiver {
    vec3 position;
    vec3 normal; // unit length, on the side that gets light; zero: all directions get light
};

// Estimates the light that a node gives to a surface, up to a factor that is the same for all nodes. It is 0
// only where no point of the node can give light, but for rounding.
SHARED_FN float lightImportance(const LightNode node, const LightReceiver to) {
    const vec3 towards = node.center - to.position;
    const float squaredDistance = dotProduct(towards, towards);
    const float distance = sqrt(max(squaredDistance, 1e-30f));
    const vec3 wi = towards / distance;
    const bool isOutside = distance > node.radius;
    const float sine = isOutside ? node.radius / distance : 0.0f;
    // Half of the angle that the sphere covers, as the point sees it.
    const Angle covered = Angle(isOutside ? sqrt(max(1.0f - sine * sine, 0.0f)) : -1.0f, sine);

    const vec2 cosines = unpackCosines(node.angles);
    const float along = -dotProduct(wi, unpackAxis(node.axis));
    const Angle fromAxis = angleOf((node.axis & kLightTwoSided) != 0u ? abs(along) : along);
    const Angle emitted = lessenedAngle(lessenedAngle(fromAxis, angleOf(cosines.x)), covered);
    const bool isAround = dotProduct(to.normal, to.normal) == 0.0f;
    const Angle arriving = lessenedAngle(angleOf(dotProduct(wi, to.normal)), covered);

    const float reach = max(max(distance, node.radius), 1e-15f);
    const float facing = emitted.cosine > cosines.y ? max(emitted.cosine, 0.0f) : 0.0f;
    const float received = isAround ? 1.0f : max(arriving.cosine, 0.0f);
    return min(node.intensity / (reach * reach), 1e30f) * facing * received;
}

// The least probability of a child that can give light, if the other can too. The other may be occluded. It
// also keeps all probabilities of a walk within the precision of u.
const float kLeastChildProbability = 2.44140625e-4f; // 2^-12

// Returns the probability of the first of two children, given that one of them is chosen. If no light of
// either reaches the surface, returns -1.
SHARED_FN float firstChildProbability(const LightNode first, const LightNode second, const LightReceiver to) {
    const float ofFirst = lightImportance(first, to);
    const float ofSecond = lightImportance(second, to);
    const float sum = ofFirst + ofSecond;
    const float least = min(ofFirst, ofSecond) > 0.0f ? kLeastChildProbability : 0.0f;
    return sum > 0.0f ? min(max(ofFirst / sum, least), 1.0f - least) : -1.0f;
}

// Chooses a light by u. The probability is 0 if no light reaches the surface.
SHARED_FN TableChoice chooseFromLightTree(SCENE_PARAMETER const PathSettings settings, const LightReceiver to,
                                          const float u) {
    uint link = loadLightNode(SCENE settings.punctualCount, 0u).link;
    float probability = 1.0f;
    float rest = u;
    bool isLeaf = link >= kLightLeaf;
    uint left = isLeaf ? 0u : 1u; // this and the `if` are as in chooseFromTable
    do {
        if (!isLeaf) {
            const LightNode first = loadLightNode(SCENE settings.punctualCount, link);
            const LightNode second = loadLightNode(SCENE settings.punctualCount, link + 1u);
            const float split = firstChildProbability(first, second, to);
            const bool isFirst = rest < split;
            const float chance = isFirst ? split : 1.0f - split;
            const float from = isFirst ? 0.0f : split;
            rest = split < 0.0f ? rest : min(max((rest - from) / max(chance, 1e-30f), 0.0f), 0.99999994f);
            probability = split < 0.0f ? 0.0f : probability * chance;
            link = isFirst ? first.link : second.link;
            isLeaf = link >= kLightLeaf;
            left = isLeaf ? 0u : 1u;
        }
    } while (!isLeaf);
    return TableChoice(link & ~kLightLeaf, probability, rest, left == 0u);
}

// The probability with which chooseFromLightTree chooses an emitter.
struct EmitterChance {
    float probability;
    bool isWhole; // false if the driver has ended a loop early: see `finish` in lib/scene.glsl
};

// Returns the probability of the emitter at `triangleId`; 0 if that is none. The scene has emitters.
SHARED_FN EmitterChance emitterChance(SCENE_PARAMETER const PathSettings settings, const LightReceiver to,
                                      const uint triangleId) {
    // Emitters are in the order of their triangles.
    uint low = 0u;
    uint high = settings.emitterCount - 1u;
    do {
        if (low < high) {
            const uint middle = (low + high) >> 1u;
            const bool isAbove = loadEmitter(SCENE middle).triangleId < triangleId;
            low = isAbove ? middle + 1u : low;
            high = isAbove ? high : middle;
        }
    } while (low < high);
    const uint unsearched = high - low;
    const Emitter emitter = loadEmitter(SCENE low);

    uint link = loadLightNode(SCENE settings.punctualCount, 0u).link;
    float probability = emitter.triangleId == triangleId ? 1.0f : 0.0f;
    uint branches = emitter.branches;
    bool isLeaf = link >= kLightLeaf;
    uint left = isLeaf ? 0u : 1u;
    do {
        if (!isLeaf) {
            const LightNode first = loadLightNode(SCENE settings.punctualCount, link);
            const LightNode second = loadLightNode(SCENE settings.punctualCount, link + 1u);
            const float split = firstChildProbability(first, second, to);
            const bool isFirst = (branches & 1u) == 0u;
            probability = split < 0.0f ? 0.0f : probability * (isFirst ? split : 1.0f - split);
            branches = branches >> 1u;
            link = isFirst ? first.link : second.link;
            isLeaf = link >= kLightLeaf;
            left = isLeaf ? 0u : 1u;
        }
    } while (!isLeaf);
    return EmitterChance(probability, unsearched + left == 0u);
}

SHARED_END
#endif
