// SPDX-License-Identifier: MIT
// Traces a buffer of rays and writes a buffer of hits: for a caller's own rays, for tests and benchmarks.
#include "lib/rays.glsl"

layout(constant_id = kSpecAnyHit) const uint anyHit = 0u;

void main() {
    const uint i = rayOfInvocation();
    if (i >= push.end) {
        return;
    }
    const RayQuery query = loadRay(i);
    const Ray ray = makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
    Trace trace = startTrace(ray);
    if (anyHit != 0u) {
        traverse(ray, true, trace);
    } else {
        traverse(ray, false, trace);
    }
    results[i] = rayResult(ray, trace.hit, trace.finished ? trace.steps : kCutShort, trace.tests);
}
