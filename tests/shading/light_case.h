// SPDX-License-Identifier: MIT
// Computes the functions of light.h and environment_map.h for one input, on CPU and device.
#ifndef METAMARCH_TESTS_SHADING_LIGHT_CASE_H
#define METAMARCH_TESTS_SHADING_LIGHT_CASE_H
#include "metamarch/shared/environment_map.h"

SHARED_BEGIN

struct LightCase {
    LightRecord light;
    vec3 point;
    float uX;
    vec3 direction; // unit length
    float uY;
    float keep;
    uint other;
    uint slotCount;
    float density;
};

struct LightAnswer {
    vec3 wi;
    float distance;
    vec3 arriving;
    float pdf;
    vec3 corners;
    float heuristic;
    vec3 mapDirection;
    uint chosen;
    vec2 mapPoint;
    vec2 mapPointOf;
    vec4 texel;
    float right;
    float down;
    uint mapColumn;
    uint mapRow;
    uint normalBin;
    float balance;
    uint padding0;
    uint padding1;
    float uRemapped;
    float mapDensity;
    float solidAngleDensity;
    uint hitsDisc;
};

SHARED_FN LightAnswer answer(const LightCase asked) {
    const vec2 u = vec2(asked.uX, asked.uY);
    const LightSample drawn = sampleLight(asked.light, asked.point, u);
    const TableEntry entry = TableEntry(asked.keep * 0.5f, asked.keep * 0.5f + 0.5f, asked.density, 0u);
    const uint slot = guideSlot(asked.uX, asked.slotCount);
    const TableChoice row = chosenEntry(entry, slot, asked.uX);
    const MapPlace seen = mapPlace(mapPoint(asked.direction), 2u * asked.slotCount, asked.slotCount);
    const MapCorners corners =
        MapCorners(vec4(asked.point, asked.density), vec4(asked.direction, asked.keep),
                   vec4(asked.light.strength, asked.uX), vec4(asked.light.direction, asked.uY));
    const MapPlace place = samplePlace(corners, slot, asked.other, asked.slotCount, u);
    LightAnswer found;
    found.wi = drawn.wi;
    found.distance = drawn.distance;
    found.arriving = drawn.arriving;
    found.pdf = drawn.pdf;
    found.corners = sampleTriangle(u);
    found.heuristic = powerHeuristic(asked.density, drawn.distance);
    found.balance = balanceHeuristic(asked.density, drawn.distance);
    found.mapDirection = mapDirection(u);
    found.chosen = row.index;
    found.mapPoint = mapPoint(asked.direction);
    found.mapPointOf = mapPointOf(place, 2u * asked.slotCount, asked.slotCount);
    found.texel = filteredTexel(corners, place.right, place.down);
    found.right = seen.right;
    found.down = seen.down;
    found.mapColumn = seen.column;
    found.mapRow = seen.row;
    found.normalBin = normalBin(asked.direction);
    found.padding0 = 0u;
    found.padding1 = 0u;
    found.uRemapped = row.uRemapped;
    found.mapDensity = mapDensity(asked.density, mapSine(asked.direction));
    found.solidAngleDensity = solidAngleDensity(asked.density, asked.uX, asked.direction.x);
    found.hitsDisc = hitsDisc(asked.light, asked.direction) ? 1u : 0u;
    return found;
}

SHARED_ASSERT_SIZE(LightCase, 96)
SHARED_ASSERT_SIZE(LightAnswer, 144)

SHARED_END
#endif
