// SPDX-License-Identifier: MIT
// Lets the driver walk its own hierarchy, with hardware if there is some (VK_KHR_ray_query).
//
// The hierarchy has one box per triangle record. Each box that the driver finds is a candidate whose triangle
// is tested here, with the triangle test of all other traversals and on the same records. So hits have the
// same bits, and differences of speed come from the traversal. If the hierarchy contained triangles, the
// driver would use its own test, which is faster in hardware but finds other hits near edges, or none. The
// boxes are in lattice space and are grown like those of bvh_stack; t is the same there.
//
// Why it ends: the driver offers each box a finite number of times.
//
// Cost: the driver's walk is not counted. A step is a candidate, with its triangle record and test.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#extension GL_EXT_ray_query : require
#include "lib/ray_query.glsl"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    rayQueryEXT query;
    rayQueryInitializeEXT(query, boxes, gl_RayFlagsNoneEXT, 0xff, ray.start, ray.tMin, ray.stride, ray.tMax);

    // Invariant: each box that the ray meets between tMin and the best hit has been tested or will be
    // offered.
    bool offered = rayQueryProceedEXT(query);
    uint left = offered ? 1u : 0u;
    while (offered) {
        ++trace.steps;
        const uint best = trace.hit.triangleId;
        testTriangles(ray, uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), 1u, trace);
        if (trace.hit.triangleId != best) {
            rayQueryGenerateIntersectionEXT(query, trace.hit.t); // the driver need not offer boxes behind it
        }
        if (isDone(trace, anyHit)) {
            finish(trace);
            return;
        }
        offered = rayQueryProceedEXT(query);
        left = offered ? 1u : 0u;
    }
    finishUnless(left, trace);
}
