// SPDX-License-Identifier: MIT
// What a ray costs when its hit is known in advance: ray and record in, one triangle test, hit out. No
// traversal can do less, so benchmarks give each one's time as a multiple of this.
#include "lib/rays.glsl"

layout(local_size_x = 64) in;

WORDS1(knownRecords, kBindKnownRecords);

void main() {
    const uint i = push.first + gl_GlobalInvocationID.x;
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
