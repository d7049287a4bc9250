// SPDX-License-Identifier: MIT
// Camera and picture of the kernels that draw one packed pixel per invocation.
#ifndef METAMARCH_LIB_PICTURE_GLSL
#define METAMARCH_LIB_PICTURE_GLSL
#include "lib/scene.glsl"
#include "lib/tiles.glsl"
#include "shared/inspect_view.h"

layout(std430, binding = kBindCamera) readonly buffer CameraBuffer { Camera camera; };
layout(std430, binding = kBindOutput) writeonly buffer PictureBuffer { uint picture[]; };
layout(push_constant) uniform PushBlock { InspectPush push; };

bool isInPicture(const uvec2 pixel) { return pixel.x < camera.width && pixel.y < camera.height; }

void setPixel(const uvec2 pixel, const uint color) { picture[pixel.y * camera.width + pixel.x] = color; }

Inspected inspected(const CameraRay view, const Ray ray, const Trace trace) {
    return Inspected(view, ray, trace.hit, trace.finished ? trace.steps : kCutShort, trace.tests);
}

// Returns a placeholder for the triangle of a miss.
TriangleRecord noTriangle() { return TriangleRecord(vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0u); }
#endif
