// Ray buffer in, hit buffer out: what tests and benchmarks run.
#include "shared/ray_query.h"

layout(local_size_x = 64) in;

layout(constant_id = kSpecAnyHit) const uint anyHit = 0u;

layout(std430, binding = kBindInput) readonly buffer RayBuffer { RayQuery queries[]; };
layout(std430, binding = kBindOutput) writeonly buffer HitBuffer { RayResult results[]; };
layout(push_constant) uniform PushBlock { RaysPush push; };

void main() {
    const uint i = push.first + gl_GlobalInvocationID.x;
    if (i >= push.end) {
        return;
    }
    const RayQuery query = queries[i];
    const Ray ray = makeRay(lattice, query.origin, query.tMin, query.dir, query.tMax);
    Trace trace = startTrace(ray);
    if (anyHit != 0u) {
        traverse(ray, true, trace);
    } else {
        traverse(ray, false, trace);
    }
    results[i] = rayResult(ray, trace.hit, trace.finished ? trace.steps : kCutShort, trace.tests);
}
