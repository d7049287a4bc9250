// What the kernels have that draw one packed pixel an invocation: camera, picture, tiles.
#ifndef METAMARCH_LIB_PICTURE_GLSL
#define METAMARCH_LIB_PICTURE_GLSL
#include "lib/scene.glsl"
#include "shared/inspect_view.h"
#include "shared/primary.h"

// No uniform: lavapipe (Mesa 22.3) copies a program whose branches depend on one whenever it changes, and
// keeps the copies as long as the pipeline, 0.8 MB each.
layout(std430, binding = kBindCamera) readonly buffer CameraBuffer { Camera camera; };
layout(std430, binding = kBindOutput) writeonly buffer PictureBuffer { uint picture[]; };
layout(push_constant) uniform PushBlock { InspectPush push; };

// Of this invocation; may lie beyond the picture's edges.
uvec2 pixelOfTile() {
    const uint tile = push.firstTile + gl_WorkGroupID.x;
    const uvec2 inTile = uvec2(gl_LocalInvocationIndex % kTileSide, gl_LocalInvocationIndex / kTileSide);
    return uvec2(tile % push.tilesPerRow, tile / push.tilesPerRow) * kTileSide + inTile;
}

bool isInPicture(const uvec2 pixel) { return pixel.x < camera.width && pixel.y < camera.height; }

void setPixel(const uvec2 pixel, const uint color) { picture[pixel.y * camera.width + pixel.x] = color; }

Inspected inspected(const CameraRay view, const Ray ray, const Trace trace) {
    return Inspected(view, ray, trace.hit, trace.finished ? trace.steps : kCutShort, trace.tests);
}

// Of no scene: what stands for the triangle of a miss.
TriangleRecord noTriangle() { return TriangleRecord(vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0u); }
#endif
