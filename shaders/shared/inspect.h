// SPDX-License-Identifier: MIT
// The debug views of surfaces and of traversal costs: from a traced camera ray to a pixel's colour.
#ifndef METAMARCH_SHARED_INSPECT_H
#define METAMARCH_SHARED_INSPECT_H
#include "false_color.h"
#include "hit_point.h"
#include "inspect_view.h"
#include "material.h"

SHARED_BEGIN

const float kUvSquares = 32.0f; // number of squares of the checkerboard per unit

// Returns the texture coordinates of the first set, even if no texture uses them.
SHARED_FN vec2 firstPlace(SCENE_PARAMETER const Surface surface, const vec3 weights) {
    const Vertex a = loadVertex(SCENE surface.vertex0);
    const Vertex b = loadVertex(SCENE surface.vertex1);
    const Vertex c = loadVertex(SCENE surface.vertex2);
    return vec2(a.u0, a.v0) * weights.x + vec2(b.u0, b.v0) * weights.y + vec2(c.u0, c.v0) * weights.z;
}

// Shows the fractional parts as red and green, on a faint checkerboard.
SHARED_FN vec3 uvColor(const vec2 uv) {
    const vec2 part = uv - floor(uv);
    const vec2 squares = floor(uv * kUvSquares);
    const float parity = (squares.x + squares.y) * 0.5f;
    const float light = parity - floor(parity) > 0.25f ? 1.0f : 0.86f;
    return vec3(part.x * light, part.y * light, 0.25f * light);
}

// `triangle` is the one that was hit; it is ignored for a miss.
SHARED_FN uint inspectedPixel(SCENE_PARAMETER const InspectPush push, const Camera camera,
                              const Inspected found, const TriangleRecord triangle) {
    if (found.steps == kCutShort) {
        return kUnfinishedColor;
    }
    if (push.view == kViewSteps || push.view == kViewTests) {
        const uint count = push.view == kViewSteps ? found.steps : found.tests;
        return packedPixel(heatColor(float(count) / push.scaleMax));
    }
    if (found.hit.triangleId == kNoTriangle) {
        return kMissColor;
    }
    if (push.view == kViewDepth) {
        // A panorama has no view axis, so its depth is the distance along the ray.
        const float t = found.ray.shift + found.hit.t;
        const float cosine = dotProduct(found.view.dir, camera.forward);
        const float depth = t * (camera.projection == kProjectionPanorama ? 1.0f : cosine);
        return packedPixel(depthColor((depth - push.scaleMin) / (push.scaleMax - push.scaleMin)));
    }
    const vec3 weights = cornerWeights(found.ray, triangle.v0, triangle.v1, triangle.v2);
    const vec3 normal = makeSurfacePoint(triangle, weights).normal;
    const float cosine = dotProduct(normal, found.view.dir);
    if (push.view == kViewNormals) {
        return packedPixel(normal * 0.5f + vec3(0.5f));
    }
    if (push.view == kViewTriangleId) {
        return packedLinear(shadedColor(idColor(found.hit.triangleId), cosine));
    }
    const Surface surface = loadSurface(SCENE found.hit.triangleId);
    if (push.view == kViewMaterialId) {
        return packedLinear(shadedColor(idColor(surface.material), cosine));
    }
    if (push.view == kViewUvs) {
        return packedPixel(uvColor(firstPlace(SCENE surface, weights)));
    }
    const MaterialRecord record = loadMaterial(SCENE surface.material);
    const TexturePoint at = finestPoint(SCENE surface, weights);
    const vec3 albedo = baseColorOf(SCENE record, vertexColor(SCENE surface, weights), at);
    if (push.view == kViewAlbedo) {
        return packedLinear(albedo);
    }
    const SurfaceFrame frame = surfaceFrame(SCENE record, surface, weights, at, normal, -found.view.dir);
    if (push.view == kViewHeadlight) {
        return packedLinear(shadedColor(albedo, dotProduct(frame.normal, found.view.dir)));
    }
    return packedPixel(frame.normal * 0.5f + vec3(0.5f));
}

// The same for the views of parameters of materials.
SHARED_FN uint parameterPixel(SCENE_PARAMETER const InspectPush push, const Inspected found,
                              const TriangleRecord triangle) {
    if (found.steps == kCutShort) {
        return kUnfinishedColor;
    }
    if (found.hit.triangleId == kNoTriangle) {
        return kMissColor;
    }
    const vec3 weights = cornerWeights(found.ray, triangle.v0, triangle.v1, triangle.v2);
    const Surface surface = loadSurface(SCENE found.hit.triangleId);
    const MaterialRecord record = loadMaterial(SCENE surface.material);
    const TexturePoint at = finestPoint(SCENE surface, weights);
    if (push.view == kViewEmissive) {
        return packedLinear(record.emission * xyz(lookUp(SCENE record.emissionTexture, at)));
    }
    if (push.view == kViewTransmission) {
        return packedPixel(vec3(transmissionOf(SCENE record, at)));
    }
    const vec2 parameters = metallicAndRoughness(SCENE record, at);
    return packedPixel(vec3(push.view == kViewMetallic ? parameters.x : parameters.y));
}

SHARED_END
#endif
