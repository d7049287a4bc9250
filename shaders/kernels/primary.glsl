// SPDX-License-Identifier: MIT
// The integrator `primary`, one invocation per pixel: camera ray, closest hit, shading by a lamp at the eye.
#include "lib/tiles.glsl"
#include "shared/primary.h"

layout(std430, binding = kBindCamera) readonly buffer CameraBuffer { Camera camera; };
layout(std430, binding = kBindOutput) writeonly buffer FilmBuffer { FilmPixel film[]; };
layout(push_constant) uniform PushBlock { PrimaryPush push; };

void main() {
    const uvec2 pixel = pixelAt(push.order, push.firstPlace + gl_WorkGroupID.x);
    if (pixel.x >= camera.width || pixel.y >= camera.height) {
        return;
    }
    const CameraRay view = cameraRay(camera, pixel.x, pixel.y);
    const Ray ray = makeRay(lattice, view.origin, 0.0, view.dir, kFarthest);
    Trace trace = startTrace(ray);
    traverse(ray, false, trace);

    FilmPixel result = missPrimary();
    if (trace.hit.triangleId != kNoTriangle) {
        const TriangleRecord triangle = loadTriangle(trace.recordIndex);
        result = shadePrimary(camera, view, ray, trace.hit, triangle,
                              materials[materialOfTriangle[trace.hit.triangleId]]);
    }
    result.rays = 1u;
    result.steps = float(trace.steps);
    result.tests = float(trace.tests);
    // A trace that the driver ended early is no sample.
    if (!trace.finished) {
        result = emptyPixel();
    }
    film[gl_WorkGroupID.x * kTilePixels + gl_LocalInvocationIndex] = result;
}
