// SPDX-License-Identifier: MIT
// The light of a scene: emitters, punctual lights and the environment, sampled by their power.
#ifndef METAMARCH_SHARED_SCENE_LIGHT_H
#define METAMARCH_SHARED_SCENE_LIGHT_H
#include "environment_map.h"
#include "hit_point.h"
#include "light.h"
#include "material.h"
#include "path_settings.h"

SHARED_BEGIN

// The tables are stored one after another: one for all lights, one for the map's rows, and one for the
// columns of each row.
SHARED_FN uint firstRow(const PathSettings settings) { return settings.lightCount; }

SHARED_FN uint firstColumn(const PathSettings settings, const uint row) {
    return settings.lightCount + settings.environmentHeight + row * settings.environmentWidth;
}

// Samples the table of `count` entries that begins at entry `first`.
SHARED_FN TableChoice chooseFromTable(SCENE_PARAMETER const uint first, const uint count, const float u) {
    uint index = loadTableEntry(SCENE first + guideSlot(u, count)).guide;
    TableEntry entry = loadTableEntry(SCENE first + index);
    // The loop ends because the last entry that can be drawn has upTo 1. The `if` is for llvmpipe, where
    // invocations that have left a loop execute its body again with the others.
    do {
        if (entry.upTo <= u) {
            ++index;
            entry = loadTableEntry(SCENE first + index);
        }
    } while (entry.upTo <= u);
    return chosenEntry(entry, index, u);
}

// Convert between the scene's axes and the map's. The map is rotated around y, right-handed: +z goes towards
// +x.
SHARED_FN vec3 turnedFromMap(const PathSettings settings, const vec3 direction) {
    return vec3(direction.x * settings.environmentCosine + direction.z * settings.environmentSine,
                direction.y,
                direction.z * settings.environmentCosine - direction.x * settings.environmentSine);
}

SHARED_FN vec3 turnedToMap(const PathSettings settings, const vec3 direction) {
    return vec3(direction.x * settings.environmentCosine - direction.z * settings.environmentSine,
                direction.y,
                direction.z * settings.environmentCosine + direction.x * settings.environmentSine);
}

// Bilinear look-up; wraps in u and clamps at the poles in v.
SHARED_FN vec3 environmentAt(SCENE_PARAMETER const PathSettings settings, const vec2 point) {
    const uint width = settings.environmentWidth;
    const uint height = settings.environmentHeight;
    const float x = point.x * float(width) - 0.5f;
    const float y = point.y * float(height) - 0.5f;
    const float left = floor(x);
    const float top = floor(y);
    const float right = x - left;
    const float down = y - top;
    const uint x0 = uint(wrapped(int(left), int(width), kWrapRepeat));
    const uint x1 = uint(wrapped(int(left) + 1, int(width), kWrapRepeat));
    const uint y0 = uint(wrapped(int(top), int(height), kWrapClamp)) * width;
    const uint y1 = uint(wrapped(int(top) + 1, int(height), kWrapClamp)) * width;
    const vec3 upper =
        loadEnvironment(SCENE y0 + x0) * (1.0f - right) + loadEnvironment(SCENE y0 + x1) * right;
    const vec3 lower =
        loadEnvironment(SCENE y1 + x0) * (1.0f - right) + loadEnvironment(SCENE y1 + x1) * right;
    return upper * (1.0f - down) + lower * down;
}

struct EnvironmentLight {
    vec3 radiance;
    float pdf; // of sampleSceneLight, per solid angle
};

// Returns the radiance from `direction` (unit length) if nothing occludes it.
SHARED_FN EnvironmentLight environmentLight(SCENE_PARAMETER const PathSettings settings,
                                            const vec3 direction) {
    if (!hasFeature(SCENE kFeatureEnvironment)) {
        return EnvironmentLight(settings.background, 0.0f);
    }
    const vec3 inMap = turnedToMap(settings, direction);
    const vec2 point = mapPoint(inMap);
    const vec3 radiance = environmentAt(SCENE settings, point) * settings.environmentScale;
    float pdf = 0.0f;
    if (hasFeature(SCENE kFeatureLights)) {
        const uint column =
            min(uint(point.x * float(settings.environmentWidth)), settings.environmentWidth - 1u);
        const uint row =
            min(uint(point.y * float(settings.environmentHeight)), settings.environmentHeight - 1u);
        const TableEntry rowEntry = loadTableEntry(SCENE firstRow(settings) + row);
        const TableEntry columnEntry = loadTableEntry(SCENE firstColumn(settings, row) + column);
        pdf = settings.environmentProbability * mapDensity(rowEntry.probability, columnEntry.probability,
                                                           settings.environmentWidth,
                                                           settings.environmentHeight, mapSine(inMap));
    }
    return EnvironmentLight(radiance, pdf);
}

SHARED_FN LightSample sampleEnvironment(SCENE_PARAMETER const PathSettings settings, const vec2 u) {
    const TableChoice row = chooseFromTable(SCENE firstRow(settings), settings.environmentHeight, u.y);
    const TableChoice column =
        chooseFromTable(SCENE firstColumn(settings, row.index), settings.environmentWidth, u.x);
    const vec2 point = mapPointIn(row, column, settings.environmentWidth, settings.environmentHeight);
    const vec3 inMap = mapDirection(point);
    const float density = mapDensity(row.probability, column.probability, settings.environmentWidth,
                                     settings.environmentHeight, mapSine(inMap));
    const vec3 radiance = environmentAt(SCENE settings, point) * settings.environmentScale;
    const vec3 arriving = density > 0.0f ? radiance / density : vec3(0.0f);
    return LightSample(turnedFromMap(settings, inMap), kFarLight, arriving, density);
}

// A sample of the light that reaches a point: the shadow ray, and what it carries if nothing occludes it.
struct SceneLightSample {
    vec3 wi;  // unit length
    vec3 end; // end of the shadow ray; unused if isFar
    bool isFar;
    vec3 arriving; // divided by the pdf of this sample
    float pdf;     // per solid angle; 0 if only light sampling can find the light
};

// Samples the light that an emitter sends from one of its points, before visibility.
SHARED_FN SceneLightSample sampleEmitter(SCENE_PARAMETER const Emitter emitter, const vec3 point,
                                         const vec2 u) {
    const vec3 weights = sampleTriangle(u);
    const TriangleRecord triangle =
        TriangleRecord(emitter.v0, emitter.triangleId, emitter.v1, 0u, emitter.v2, 0u);
    const SurfacePoint light = makeSurfacePoint(triangle, weights);
    const vec3 towards = light.position - point;
    const float squaredDistance = dotProduct(towards, towards);
    const vec3 wi = squaredDistance > 0.0f ? unitVector(towards) : light.normal;
    const float cosine = -dotProduct(wi, light.normal);

    const MaterialRecord material = loadMaterial(SCENE emitter.material);
    vec3 radiance = material.emission;
    if (hasFeature(SCENE kFeatureTextures | kFeatureAlpha)) {
        const Surface surface = loadSurface(SCENE emitter.triangleId);
        const TexturePoint at = finestPoint(SCENE surface, weights);
        const vec4 texel = lookUp(SCENE material.emissionTexture, at);
        radiance =
            radiance * vec3(texel.x, texel.y, texel.z) * coverage(SCENE material, surface, weights, at);
    }
    const bool isSeen = cosine > 0.0f || (material.flags & kMaterialDoubleSided) != 0u;
    const float pdf = solidAngleDensity(material.emissionDensity, squaredDistance, cosine);
    const vec3 arriving = isSeen && pdf > 0.0f ? radiance / pdf : vec3(0.0f);
    return SceneLightSample(wi, offsetPoint(light, -towards), false, arriving, pdf);
}

SHARED_FN SceneLightSample sampleSceneLight(SCENE_PARAMETER const PathSettings settings, const vec3 point,
                                            const vec2 u) {
    const TableChoice choice = chooseFromTable(SCENE 0u, settings.lightCount, u.x);
    const vec2 uPoint = vec2(choice.uRemapped, u.y);
    const uint firstPunctual = settings.emitterCount;
    const uint environment = settings.emitterCount + settings.punctualCount;
    SceneLightSample result = SceneLightSample(vec3(0.0f, 1.0f, 0.0f), point, true, vec3(0.0f), 0.0f);
    if (hasFeature(SCENE kFeatureEmission) && choice.index < firstPunctual) {
        result = sampleEmitter(SCENE loadEmitter(SCENE choice.index), point, uPoint);
    }
    if (settings.punctualCount > 0u && choice.index >= firstPunctual && choice.index < environment) {
        const LightSample light = sampleLight(loadLight(SCENE choice.index - firstPunctual), point, uPoint);
        const bool isFar = light.distance == kFarLight;
        result = SceneLightSample(light.wi, isFar ? point : point + light.wi * light.distance, isFar,
                                  light.arriving / choice.probability, light.pdf * choice.probability);
    }
    if (hasFeature(SCENE kFeatureEnvironment) && choice.index == environment) {
        const LightSample light = sampleEnvironment(SCENE settings, uPoint);
        const float probability = settings.environmentProbability;
        result =
            SceneLightSample(light.wi, point, true, light.arriving / probability, light.pdf * probability);
    }
    return result;
}

SHARED_END
#endif
