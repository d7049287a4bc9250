// SPDX-License-Identifier: MIT
// Asks the driver: its own hierarchy, walked by its own hardware where there is some (VK_KHR_ray_query).
//
// The hierarchy holds one box per triangle record, and each box that the driver finds is a candidate whose
// triangle is tested here. So the triangle test is that of every other traversal, which sees the same
// records: hits are the same bits and differences of speed are the traversal's. With triangles in the
// hierarchy the driver would decide by a test of its own, faster in hardware, which near edges finds other
// hits or none. The boxes lie in lattice space, grown as those of bvh_stack, and t is the same there.
//
// Why it ends: the driver offers each box a finite number of times.
//
// What it costs: the walk is the driver's business and not counted; a step is a candidate, with its triangle
// record and test.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#extension GL_EXT_ray_query : require
#include "lib/ray_query.glsl"

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    rayQueryEXT query;
    rayQueryInitializeEXT(query, boxes, gl_RayFlagsNoneEXT, 0xff, ray.start, ray.tMin, ray.stride, ray.tMax);

    // Holds here: boxes that the ray meets between tMin and the best hit are tested, or still to be offered.
    bool offered = rayQueryProceedEXT(query);
    while (offered) {
        ++trace.steps;
        const uint best = trace.hit.triangleId;
        testTriangles(ray, uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)), 1u, trace);
        if (trace.hit.triangleId != best) {
            rayQueryGenerateIntersectionEXT(query, trace.hit.t); // boxes behind it need not be offered
        }
        if (isDone(trace, anyHit)) {
            finish(trace);
            return;
        }
        offered = rayQueryProceedEXT(query);
    }
    trace.expectedTests += offered ? 1u : 0u; // not finished, where the loop was cut short
    finish(trace);
}
