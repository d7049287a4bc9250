// SPDX-License-Identifier: MIT
// The light of a scene: emitters, punctual lights and the environment, sampled by their power.
#ifndef METAMARCH_SHARED_SCENE_LIGHT_H
#define METAMARCH_SHARED_SCENE_LIGHT_H
#include "environment_map.h"
#include "hit_point.h"
#include "light.h"
#include "light_tree.h"
#include "material.h"
#include "path_settings.h"

SHARED_BEGIN

// Returns the entry of a punctual light in the table of lights.
SHARED_FN uint punctualEntry(SCENE_PARAMETER const PathSettings settings, const uint light) {
    return (hasFeature(SCENE kFeatureLightTree) ? 1u : settings.emitterCount) + light;
}

// The tables are stored one after another: one for all lights; for each bin of normals, one for the map's
// blocks; for each column of blocks, those for the rows of its blocks; for each row of cells, those for the
// columns of its blocks. In a table of blocks, `probability` is the factor of bin and block.
SHARED_FN uint firstBlock(const PathSettings settings, const uint bin) {
    return settings.lightCount + bin * kMapBlocks;
}

SHARED_FN uint firstRow(const PathSettings settings, const uint blockColumn) {
    return firstBlock(settings, kAnyNormal + 1u) + blockColumn * (settings.environmentHeight + 1u);
}

SHARED_FN uint firstColumn(const PathSettings settings, const uint row) {
    return firstRow(settings, kBlocksAcross) + row * settings.environmentWidth;
}

SHARED_FN uint blockOf(const PathSettings settings, const MapPlace place) {
    return ((place.row >> settings.blockRowShift) << kBlockRowShift) +
           (place.column >> settings.blockColumnShift);
}

// Samples the table of `count` entries that begins at entry `first`.
SHARED_FN TableChoice chooseFromTable(SCENE_PARAMETER const uint first, const uint count, const float u) {
    uint index = loadTableEntry(SCENE first + guideSlot(u, count)).guide;
    TableEntry entry = loadTableEntry(SCENE first + index);
    // The loop ends because the last entry that can be drawn has upTo 1. The `if` is for llvmpipe, where
    // invocations that have left a loop execute its body again with the others. `left` is as in finishUnless
    // of lib/scene.glsl.
    bool isFound = entry.upTo > u;
    uint left = isFound ? 0u : 1u;
    do {
        if (!isFound) {
            ++index;
            entry = loadTableEntry(SCENE first + index);
            isFound = entry.upTo > u;
            left = isFound ? 0u : 1u;
        }
    } while (!isFound);
    const TableChoice choice = chosenEntry(entry, index, u);
    return TableChoice(index, choice.probability, choice.uRemapped, left == 0u);
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

// Loads the texels around a cell; see MapPlace.
SHARED_FN MapCorners loadMapCorners(SCENE_PARAMETER const PathSettings settings, const uint column,
                                    const uint row) {
    const uint width = settings.environmentWidth;
    const uint x1 = column + 1u == width ? 0u : column + 1u;
    const uint y0 = (max(row, 1u) - 1u) * width;
    const uint y1 = min(row, settings.environmentHeight - 1u) * width;
    return MapCorners(loadEnvironment(SCENE y0 + column), loadEnvironment(SCENE y0 + x1),
                      loadEnvironment(SCENE y1 + column), loadEnvironment(SCENE y1 + x1));
}

struct EnvironmentLight {
    vec3 radiance;
    float pdf; // of sampleSceneLight, per solid angle
};

// Returns the radiance from `direction` (unit length) if nothing occludes it. `bin` is that of the surface
// which the ray has left.
SHARED_FN EnvironmentLight environmentLight(SCENE_PARAMETER const PathSettings settings, const vec3 direction,
                                            const uint bin) {
    if (!hasFeature(SCENE kFeatureEnvironment)) {
        return EnvironmentLight(settings.background, 0.0f);
    }
    const vec3 inMap = turnedToMap(settings, direction);
    const MapPlace place = mapPlace(mapPoint(inMap), settings.environmentWidth, settings.environmentHeight);
    const vec4 texel =
        filteredTexel(loadMapCorners(SCENE settings, place.column, place.row), place.right, place.down);
    float pdf = 0.0f;
    if (hasFeature(SCENE kFeatureLights)) {
        const float factor =
            loadTableEntry(SCENE firstBlock(settings, bin) + blockOf(settings, place)).probability;
        pdf = settings.environmentProbability * mapDensity(texel.w * factor, mapSine(inMap));
    }
    return EnvironmentLight(xyz(texel) * settings.environmentScale, pdf);
}

// `bin` is that of the surface.
SHARED_FN LightSample sampleEnvironment(SCENE_PARAMETER const PathSettings settings, const uint bin,
                                        const vec2 u) {
    const TableChoice block = chooseFromTable(SCENE firstBlock(settings, bin), kMapBlocks, u.y);
    const uint blockColumn = block.index & (kBlocksAcross - 1u);
    const uint startColumn = blockColumn << settings.blockColumnShift;
    const uint startRow = (block.index >> kBlockRowShift) << settings.blockRowShift;
    const uint rowCount = min(1u << settings.blockRowShift, settings.environmentHeight + 1u - startRow);
    const uint columnCount = min(1u << settings.blockColumnShift, settings.environmentWidth - startColumn);
    const TableChoice inRows =
        chooseFromTable(SCENE firstRow(settings, blockColumn) + startRow, rowCount, block.uRemapped);
    const uint row = startRow + inRows.index;
    const TableChoice inColumns =
        chooseFromTable(SCENE firstColumn(settings, row) + startColumn, columnCount, u.x);
    const uint column = startColumn + inColumns.index;
    const MapCorners corners = loadMapCorners(SCENE settings, column, row);
    const MapPlace place = samplePlace(corners, column, row, settings.environmentHeight,
                                       vec2(inColumns.uRemapped, inRows.uRemapped));
    const vec4 texel = filteredTexel(corners, place.right, place.down);
    const vec3 inMap = mapDirection(mapPointOf(place, settings.environmentWidth, settings.environmentHeight));
    const float density = mapDensity(texel.w * block.probability, mapSine(inMap));
    const vec3 radiance = xyz(texel) * settings.environmentScale;
    const vec3 arriving = density > 0.0f ? radiance / density : vec3(0.0f);
    const bool isWhole = block.isWhole && inRows.isWhole && inColumns.isWhole;
    return LightSample(turnedFromMap(settings, inMap), kFarLight, arriving, density, isWhole);
}

// A sample of the light that reaches a point: the shadow ray, and what it carries if nothing occludes it.
struct SceneLightSample {
    vec3 wi;  // unit length
    vec3 end; // end of the shadow ray; unused if isFar
    bool isFar;
    vec3 arriving; // divided by the pdf of this sample
    float pdf;     // per solid angle; 0 if only light sampling can find the light
    bool isMap;    // it comes from the environment map
    bool isWhole;  // as in TableChoice
};

// Returns the probability density over the area of an emitter. Where `probability` of choosing it depends on
// the surface, it is divided by its own area; otherwise it is a constant of the material.
SHARED_FN float emitterDensity(SCENE_PARAMETER const MaterialRecord material, const TriangleRecord triangle,
                               const float probability) {
    if (!hasFeature(SCENE kFeatureLightTree)) {
        return material.emissionDensity;
    }
    const vec3 scaled = scaledNormal(triangle.v0, triangle.v1, triangle.v2);
    const float size = largest(abs(scaled)); // keeps the square within the range of floats
    const vec3 normal = scaled / size;
    return probability / (0.5f * size * sqrt(dotProduct(normal, normal)));
}

// Samples the light that an emitter sends from one of its points, before visibility. `probability` is that
// of choosing the emitter.
SHARED_FN SceneLightSample sampleEmitter(SCENE_PARAMETER const Emitter emitter, const float probability,
                                         const vec3 point, const vec2 u) {
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
    const float pdf =
        solidAngleDensity(emitterDensity(SCENE material, triangle, probability), squaredDistance, cosine);
    const vec3 arriving = isSeen && pdf > 0.0f ? radiance / pdf : vec3(0.0f);
    return SceneLightSample(wi, offsetPoint(light, -towards), false, arriving, pdf, false, true);
}

// Chooses a light. Emitters come first, then punctual lights, then the environment map.
SHARED_FN TableChoice chooseLight(SCENE_PARAMETER const PathSettings settings, const LightReceiver to,
                                  const float u) {
    const TableChoice choice = chooseFromTable(SCENE 0u, settings.lightCount, u);
    if (!hasFeature(SCENE kFeatureLightTree)) {
        return choice;
    }
    if (choice.index > 0u) {
        return TableChoice(settings.emitterCount + choice.index - 1u, choice.probability, choice.uRemapped,
                           choice.isWhole);
    }
    const TableChoice inTree = chooseFromLightTree(SCENE settings, to, choice.uRemapped);
    return TableChoice(inTree.index, inTree.probability * choice.probability, inTree.uRemapped,
                       inTree.isWhole && choice.isWhole);
}

// Returns the probability with which chooseLight chooses the emitter at `triangleId`. It is not computed
// without kFeatureLightTree.
SHARED_FN EmitterChance chanceOfEmitter(SCENE_PARAMETER const PathSettings settings, const LightReceiver to,
                                        const uint triangleId) {
    const EmitterChance chance = emitterChance(SCENE settings, to, triangleId);
    return EmitterChance(chance.probability * loadTableEntry(SCENE 0u).probability, chance.isWhole);
}

// `bin` is that of the surface.
SHARED_FN SceneLightSample sampleSceneLight(SCENE_PARAMETER const PathSettings settings,
                                            const LightReceiver to, const uint bin, const vec2 u) {
    const TableChoice choice = chooseLight(SCENE settings, to, u.x);
    const vec3 point = to.position;
    const vec2 uPoint = vec2(choice.uRemapped, u.y);
    const uint firstPunctual = settings.emitterCount;
    const uint environment = settings.emitterCount + settings.punctualCount;
    SceneLightSample result =
        SceneLightSample(vec3(0.0f, 1.0f, 0.0f), point, true, vec3(0.0f), 0.0f, false, true);
    if (hasFeature(SCENE kFeatureEmission) && choice.index < firstPunctual) {
        result = sampleEmitter(SCENE loadEmitter(SCENE choice.index), choice.probability, point, uPoint);
    }
    if (settings.punctualCount > 0u && choice.index >= firstPunctual && choice.index < environment) {
        const LightSample light = sampleLight(loadLight(SCENE choice.index - firstPunctual), point, uPoint);
        const bool isFar = light.distance == kFarLight;
        result =
            SceneLightSample(light.wi, isFar ? point : point + light.wi * light.distance, isFar,
                             choice.probability > 0.0f ? light.arriving / choice.probability : vec3(0.0f),
                             light.pdf * choice.probability, false, true);
    }
    if (hasFeature(SCENE kFeatureEnvironment) && choice.index == environment) {
        const LightSample light = sampleEnvironment(SCENE settings, bin, uPoint);
        const float probability = settings.environmentProbability;
        result = SceneLightSample(light.wi, point, true, light.arriving / probability,
                                  light.pdf * probability, true, light.isWhole);
    }
    return SceneLightSample(result.wi, result.end, result.isFar, result.arriving, result.pdf, result.isMap,
                            result.isWhole && choice.isWhole);
}

SHARED_END
#endif
