// SPDX-License-Identifier: MIT
// Measures the cost of a ray whose hit is known in advance: it loads the ray and the record, tests one
// triangle and stores the hit. No traversal can do less, so benchmarks give each traversal's time as a
// multiple of this.
#include "lib/rays.glsl"

WORDS1(knownRecords, kBindKnownRecords);

void main() {
    const uint i = rayOfInvocation();
    if (i >= push.end) {
        return;
    }
    const RayQuery query = loadRay(i);
    const Ray ray = makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
    const uint recordIndex = LOAD1(knownRecords, i);
    Trace trace = startTrace(ray);
    if (recordIndex != kNoRecord) {
        testTriangle(ray, recordIndex, trace);
    }
    results[i] = rayResult(ray, trace.hit, trace.steps, trace.tests);
}
