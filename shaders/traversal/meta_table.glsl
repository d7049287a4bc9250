// SPDX-License-Identifier: MIT
// Marches through the meta table: one look-up per leaf crossed, no stack, no tree.
//
// The table gives the leaf of the ray's cell. The ray meets the small boxes of the leaf's references, and the
// triangles whose boxes it meets are tested. Then the ray leaves the leaf's exit box through one of the three
// far planes and enters the next cell. Seo, Kang, Yang, "An Effective Ray Tracing Algorithm Using a Meta
// Table"; the integer steps follow Pérard-Gayot, Kalojanov, Slusallek, "GPU Ray Tracing using Irregular
// Grids", 2017.
//
// Why it ends: leaveBox moves the cell on by at least one on one axis and never back on the others, and the
// loop ends outside the lattice. So there are at most as many steps as the sum of the three resolutions,
// whatever the rounding errors.
//
// Cost per step: one table entry, or two where leaves meet in a brick, and the 16-byte head of a leaf. A leaf
// with triangles has a 16-byte frame, 16 bytes for each four references, and for the triangles whose boxes
// the ray meets an index and the triangle. No memory per ray.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#include "lib/meta_table.glsl"
#include "lib/reference_boxes.glsl"
#include "shared/march.h"

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }
    const uvec3 shift = nearPlaneShift(ray);
    BoxExit next = BoxExit(ray.tNear, cellAt(ray, ray.tNear, ivec3(0), ivec3(lattice.resolution)));
    LeafHead leaf = LeafHead(0u, 0u, 0u, 0u);
    FrameCrossing frame = FrameCrossing(vec3(0.0), vec3(0.0));
    uint group = 0u;       // entry of the next group of boxes
    uint indices = 0u;     // entry of the first group of the leaf's indices
    vec2 span = vec2(0.0); // the part of the ray in the leaf's frame
    uint met = 0u;         // number of the leaf's references whose boxes the ray has met or missed
    uint left = 1u;        // not 0 while there is work left to do

    // llvmpipe (Mesa 22.3.6) leaves a loop only at its end, so a condition at the top costs one more turn. It
    // executes a loop again for rays that have left it, and only assignments under a condition do not change
    // them. So each loop asks at its end and does all work under a condition.
    //
    // Invariant: next.cell is in the lattice, and every triangle that the ray meets before it has been
    // tested, except for those of `leaf` from reference `met` on.
    bool isOn = true;
    do {
        if (isOn) {
            // Most leaves on the way are empty, or the ray misses their frame. They have a loop of their own,
            // because llvmpipe would execute the tests below for each of them.
            bool isStepping = met >= leaf.triangleCount;
            do {
                if (isStepping) {
                    ++trace.steps;
                    const uint record = wordAt(next.cell, lattice.resolution);
                    leaf = loadHead(record);
                    const float tNear = next.t;
                    next = leaveBox(ray, unpackCell(leaf.lo), unpackCell(leaf.hi), next.cell);
                    if (leaf.triangleCount != 0u) {
                        const LeafFrame stored = loadFrame(record);
                        frame = crossFrame(ray, stored);
                        group = firstBoxes(record);
                        indices = stored.firstIndices;
                        span = crossReferenceBox(frame, shift, kWholeFrame,
                                                 vec2(tNear, smaller(next.t, trace.hit.t)));
                        leaf.triangleCount = span.x <= span.y ? leaf.triangleCount : 0u;
                    }
                    met = 0u;
                    isStepping = leaf.triangleCount == 0u && next.t < trace.hit.t &&
                                 isInLattice(next.cell, lattice.resolution);
                }
            } while (isStepping);

            uint candidates = 0u; // bit i: reference firstMet + i
            const uint firstMet = met;
            bool isMeeting = met < leaf.triangleCount;
            do {
                if (isMeeting) {
                    candidates |= meetBoxes(frame, shift, loadBoxes(group), span) << (met - firstMet);
                    ++group;
                    met += kBoxesPerGroup;
                    isMeeting = met < leaf.triangleCount && met - firstMet < kMostCandidates;
                }
            } while (isMeeting);

            bool isTesting = candidates != 0u;
            do {
                if (isTesting) {
                    const uint reference = firstMet + uint(findLSB(candidates));
                    testTriangle(ray, loadTriangleIndex(indices, reference), trace);
                    candidates &= candidates - 1u;
                    isTesting = candidates != 0u && !isDone(trace, anyHit);
                }
            } while (isTesting);

            // A triangle may extend beyond the box, so only a hit inside the box is known to be the closest.
            isOn = !isDone(trace, anyHit) &&
                   (met < leaf.triangleCount ||
                    (trace.hit.t > next.t && isInLattice(next.cell, lattice.resolution)));
            left = isDone(trace, anyHit) ? 0u : candidates | (isOn ? 1u : 0u);
        }
    } while (isOn);
    trace.expectedTests = trace.tests;
    finishUnless(left, trace);
}
