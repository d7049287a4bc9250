// One invocation a pixel: the ray through its centre, the closest hit, and the colour of one view of them.
#include "lib/shading.glsl"
#include "shared/inspect.h"
#include "shared/primary.h"

layout(local_size_x = kTilePixels) in;

layout(std140, binding = kBindCamera) uniform CameraBuffer { Camera camera; };
layout(std430, binding = kBindOutput) writeonly buffer PictureBuffer { uint picture[]; };
layout(push_constant) uniform PushBlock { InspectPush push; };

void main() {
    const uint tile = push.firstTile + gl_WorkGroupID.x;
    const uvec2 inTile = uvec2(gl_LocalInvocationIndex % kTileSide, gl_LocalInvocationIndex / kTileSide);
    const uvec2 pixel = uvec2(tile % push.tilesPerRow, tile / push.tilesPerRow) * kTileSide + inTile;
    if (pixel.x >= camera.width || pixel.y >= camera.height) {
        return;
    }
    const CameraRay view = centerRay(camera, pixel.x, pixel.y);
    const Ray ray = makeRay(lattice, view.origin, 0.0, view.dir, kFarthest);
    Trace trace = startTrace(ray);
    traverse(ray, false, trace);

    TriangleRecord triangle = TriangleRecord(vec3(0.0), 0u, vec3(0.0), 0u, vec3(0.0), 0u);
    if (trace.hit.triangleId != kNoTriangle) {
        triangle = loadTriangle(trace.slot);
    }
    const Inspected found =
        Inspected(view, ray, trace.hit, trace.finished ? trace.steps : kCutShort, trace.tests);
    picture[pixel.y * camera.width + pixel.x] = inspectedPixel(push, camera, found, triangle);
}
