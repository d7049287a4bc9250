// SPDX-License-Identifier: MIT
// Debug views of the meta table at the point that a camera ray hit: from cell and leaf to a pixel's colour.
#ifndef METAMARCH_SHARED_CELLS_H
#define METAMARCH_SHARED_CELLS_H
#include "false_color.h"
#include "hit_point.h"
#include "inspect_view.h"
#include "march.h"

SHARED_BEGIN

// The cell in which a point lies and, per axis, the nearest lattice plane.
struct CellPlace {
    vec3 position; // lattice space
    ivec3 cell;
    ivec3 side; // -1 if that plane is the cell's lower one, else 1
    vec3 gap;   // distance from the point to that plane, in cells
};

// Returns the place at `t` along the ray; t counts as in the march.
SHARED_FN CellPlace cellPlace(const Ray ray, const float t, const uvec3 resolution) {
    const vec3 position = ray.start + ray.stride * t;
    const ivec3 cell = cellAt(ray, t, ivec3(0), ivec3(resolution));
    const vec3 inCell = position - vec3(cell);
    const vec3 gap = max(min(inCell, vec3(1.0f) - inCell), vec3(0.0f));
    const ivec3 side = ivec3(inCell.x < 0.5f ? -1 : 1, inCell.y < 0.5f ? -1 : 1, inCell.z < 0.5f ? -1 : 1);
    return CellPlace(position, cell, side, gap);
}

const uint kNoLeaf = 0xffffffffu;

// The table's content at a place.
struct CellFacts {
    CellPlace place;
    uint leafId;
    uvec3 leafBeside; // per axis, the leaf beyond that plane; kNoLeaf outside the lattice
    uint exitLo;      // packCell; the leaf's exit box
    uint exitHi;
};

// Returns a placeholder for a miss.
SHARED_FN CellFacts noCellFacts() {
    return CellFacts(CellPlace(vec3(0.0f), ivec3(0), ivec3(0), vec3(0.0f)), kNoLeaf, uvec3(kNoLeaf), 0u, 0u);
}

// Returns how far the visible point moves in the triangle's plane if the ray turns to a neighbouring pixel's.
// H. Igehy, "Tracing Ray Differentials", 1999.
SHARED_FN vec3 pixelStep(const CameraRay view, const CameraRay next, const float t, const vec3 normal) {
    const float kLeastCosine = 1e-4f; // at steeper angles no line can be drawn
    const vec3 moved = next.origin - view.origin + (next.dir - view.dir) * t;
    const float cosine = dotProduct(view.dir, normal);
    const float bounded = max(abs(cosine), kLeastCosine) * (cosine < 0.0f ? -1.0f : 1.0f);
    return moved - view.dir * (dotProduct(moved, normal) / bounded);
}

// Returns, per axis, by how many cells the visible point moves from one pixel to the next.
SHARED_FN vec3 cellsPerPixel(const Camera camera, const uvec2 pixel, const Lattice lattice,
                             const Inspected found, const vec3 normal) {
    const float t = found.ray.shift + found.hit.t;
    const CameraRay toRight = centerRay(camera, pixel.x + 1u, pixel.y);
    const CameraRay below = centerRay(camera, pixel.x, pixel.y + 1u);
    const vec3 right = pixelStep(found.view, toRight, t, normal) * lattice.cellsPerUnit;
    const vec3 down = pixelStep(found.view, below, t, normal) * lattice.cellsPerUnit;
    const vec3 squares = right * right + down * down;
    return vec3(sqrt(squares.x), sqrt(squares.y), sqrt(squares.z));
}

// A surface that lies in a lattice plane up to rounding gets no line there; one with at least this relative
// slope does.
const float kLeastSlope = 0.015625f;

// Returns the fraction of a pixel that is covered by a line `width` pixels wide and `gap` cells away.
SHARED_FN float lineCover(const float gap, const float span, const float widestSpan, const float width) {
    const float pixels = gap / max(span, 1e-20f);
    const float cover = min(max(0.5f * width + 0.5f - pixels, 0.0f), 1.0f);
    return span > kLeastSlope * widestSpan ? cover : 0.0f;
}

SHARED_FN vec3 lineCovers(const vec3 gap, const vec3 span, const float width) {
    const float widest = largest(span);
    return vec3(lineCover(gap.x, span.x, widest, width), lineCover(gap.y, span.y, widest, width),
                lineCover(gap.z, span.z, widest, width));
}

// Returns the opacity of lines that are `spacing` cells apart; 0 if they would merge into each other.
SHARED_FN float densityFade(const float spacing, const float span) {
    const float kFewestPixels = 3.0f; // between two lines
    const float kFadePixels = 4.0f;
    const float pixels = spacing / max(span, 1e-6f);
    return min(max((pixels - kFewestPixels) / kFadePixels, 0.0f), 1.0f);
}

SHARED_FN vec3 densityFades(const vec3 spacing, const vec3 span) {
    return vec3(densityFade(spacing.x, span.x), densityFade(spacing.y, span.y),
                densityFade(spacing.z, span.z));
}

const float kCellLine = 1.0f; // pixels
const float kLeafLine = 1.6f;
const float kBoxLine = 1.6f;

// Draws a light surface with thin lines between cells and thick ones between leaves. The distance between
// leaf borders is unknown, so where cells are too small to be visible, leaf borders remain faintly.
SHARED_FN vec3 cellBordersColor(const CellFacts facts, const vec3 span, const float cosine) {
    const uvec3 beside = facts.leafBeside;
    const vec3 isInside = vec3(beside.x != kNoLeaf ? 1.0f : 0.0f, beside.y != kNoLeaf ? 1.0f : 0.0f,
                               beside.z != kNoLeaf ? 1.0f : 0.0f);
    const vec3 isLeaf = vec3(beside.x != facts.leafId ? 1.0f : 0.0f, beside.y != facts.leafId ? 1.0f : 0.0f,
                             beside.z != facts.leafId ? 1.0f : 0.0f);
    const vec3 fades = densityFades(vec3(1.0f), span);
    const vec3 cells = lineCovers(facts.place.gap, span, kCellLine) * isInside * fades;
    const vec3 leaves =
        lineCovers(facts.place.gap, span, kLeafLine) * isInside * isLeaf * (vec3(0.3f) + fades * 0.7f);
    const vec3 surface = shadedColor(vec3(0.62f, 0.62f, 0.6f), cosine);
    const vec3 withCells = blend3(surface, vec3(0.2f, 0.3f, 0.42f), 0.55f * largest(cells));
    return blend3(withCells, vec3(0.75f, 0.1f, 0.02f), largest(leaves));
}

// Gives each box a colour, with dark lines at its borders.
SHARED_FN vec3 exitBoxColor(const CellFacts facts, const vec3 span, const float cosine) {
    const vec3 lo = vec3(unpackCell(facts.exitLo));
    const vec3 hi = vec3(unpackCell(facts.exitHi));
    const vec3 gap = max(min(facts.place.position - lo, hi - facts.place.position), vec3(0.0f));
    const vec3 lines = lineCovers(gap, span, kBoxLine) * densityFades(hi - lo, span);
    const vec3 color = shadedColor(idColor(facts.exitLo ^ hashed(facts.exitHi)), cosine);
    return blend3(color, vec3(0.02f), 0.85f * largest(lines));
}

// `triangle` is the one that was hit, and `facts` are those at the hit point; both are ignored for a miss.
SHARED_FN uint cellsPixel(const InspectPush push, const Camera camera, const uvec2 pixel,
                          const Lattice lattice, const Inspected found, const TriangleRecord triangle,
                          const CellFacts facts) {
    if (found.steps == kCutShort) {
        return kUnfinishedColor;
    }
    if (found.hit.triangleId == kNoTriangle) {
        return kMissColor;
    }
    const vec3 weights = cornerWeights(found.ray, triangle.v0, triangle.v1, triangle.v2);
    const vec3 normal = makeSurfacePoint(triangle, weights).normal;
    const float cosine = dotProduct(normal, found.view.dir);
    if (push.view == kViewLeafId) {
        return packedLinear(shadedColor(idColor(facts.leafId), cosine));
    }
    const vec3 span = cellsPerPixel(camera, pixel, lattice, found, normal);
    const vec3 color = push.view == kViewCellBorders ? cellBordersColor(facts, span, cosine)
                                                     : exitBoxColor(facts, span, cosine);
    return packedLinear(color);
}

SHARED_END
#endif
