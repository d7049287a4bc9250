// SPDX-License-Identifier: MIT
// Traces the ray through a pixel's centre, one invocation per pixel, and shows its closest hit in one view.
#include "lib/shading.glsl"
// Comes after shading.glsl, which defines the features that its camera asks for.
#include "lib/picture.glsl"
#include "shared/inspect.h"

layout(constant_id = kSpecParameters) const uint hasParameters = 0u;

void main() {
    const uvec2 pixel = pixelAt(push.order, push.firstPlace + gl_WorkGroupID.x);
    if (!isInPicture(pixel)) {
        return;
    }
    const CameraRay view = centerRay(camera, pixel.x, pixel.y);
    const Ray ray = makeRay(lattice, view.origin, 0.0, view.dir, kFarthest);
    Trace trace = startTrace(ray);
    traverse(ray, false, trace);

    TriangleRecord triangle = noTriangle();
    if (trace.hit.triangleId != kNoTriangle) {
        triangle = loadTriangle(trace.recordIndex);
    }
    const Inspected found = inspected(view, ray, trace);
    setPixel(pixel, hasParameters != 0u ? parameterPixel(push, found, triangle)
                                        : inspectedPixel(push, camera, found, triangle));
}
