// SPDX-License-Identifier: MIT
// Traces a buffer of rays and writes a buffer of hits, for tests and benchmarks.
#include "lib/rays.glsl"

layout(local_size_x = 64) in;

layout(constant_id = kSpecAnyHit) const uint anyHit = 0u;

void main() {
    const uint i = push.first + gl_GlobalInvocationID.x;
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
