// SPDX-License-Identifier: MIT
// The path tracer, one invocation per pixel. Each turn of the loop takes a path to its next surface. When a
// path ends, the pixel's next sample begins in the same turn, so that no invocation waits for its neighbours'
// longer paths, and the state of a path never leaves the registers. The judge on the CPU has no such
// neighbours: src/reference/path.cpp has a plain loop over the surfaces of one sample. shared/path.h has the
// code of a turn that both share.
#include "lib/shading.glsl"
#include "lib/tiles.glsl"
#include "shared/film.h"
#include "shared/path.h"
#include "shared/path_input.h"

layout(std430, binding = kBindInput) readonly buffer InputBuffer {
    Camera camera;
    PathSettings settings;
    uint areaLeft;
    uint areaTop;
    uint areaWidth;
    uint areaHeight;
};
layout(std430, binding = kBindOutput) buffer FilmBuffer { FilmPixel film[]; };
layout(std430, binding = kBindTotal) writeonly buffer TotalBuffer { FilmPixel total[]; };
layout(std430, binding = kBindLight) buffer LightBuffer { LightParts filmLight[]; };
layout(std430, binding = kBindHits) writeonly buffer HitBuffer { uint firstHits[]; };
layout(std430, binding = kBindPathStatus) buffer StatusBuffer { PathStatus status; };
layout(push_constant) uniform PushBlock { PathPush push; };

// Adds to a Count in a buffer. It is a macro because GLSL passes no buffer variable to a function. The low
// word has wrapped if the sum is below what was added.
#define ADD_COUNT(count, added)                                                                              \
    if (atomicAdd(count.low, added) + (added) < (added)) {                                                   \
        atomicAdd(count.high, 1u);                                                                           \
    }

layout(constant_id = kSpecFilm) const uint filmParts = kFilmLight | kFilmHits;

// Finds the closest triangle that is there for this path, or any such triangle, and what is in the way. The
// CPU's loop ends in its middle. This one ends only at its end and does all work under a condition, because
// of llvmpipe.
Trace traceOpaque(const Ray given, const bool anyHit, const PixelSample at, const uint dimension,
                  const Passing passed, out InWay inWay) {
    Trace trace = startTrace(given);
    inWay = nothingInWay();
    // Only rays to lights, which ask for any hit, go through panes.
    if (!hasFeature(kFeatureAlpha | kFeatureCatcher) && !(hasFeature(kFeatureThinGlass) && anyHit)) {
        traverse(given, anyHit, trace);
        inWay.first = trace.hit.triangleId == kNoTriangle ? kNothing : kObject;
        return trace;
    }
    Ray ray = given;
    uint steps = 0u;
    uint tests = 0u;
    bool isDone = false;
    uint left = 1u; // as in finishUnless
    do {
        // The condition is needed because llvmpipe executes the loop again for lanes that have left it.
        if (!isDone) {
            Trace next = startTrace(ray);
            traverse(ray, false, next);
            steps += next.steps;
            tests += next.tests;
            isDone = !next.finished || next.hit.triangleId == kNoTriangle;
            if (inWay.first == kNothing) {
                trace = next;
            }
            trace.finished = next.finished;
            if (!isDone) {
                inWay = meetInWay(inWay, ray, loadTriangle(next.recordIndex), at, dimension, passed);
                isDone = passed.isToLamps ? inWay.last == kLamp : inWay.last != kNothing;
                ray = rayBehind(ray, next.hit.t);
            }
            left = isDone ? 0u : 1u;
        }
    } while (!isDone);
    trace.finished = trace.finished && left == 0u;
    trace.steps = steps;
    trace.tests = tests;
    return trace;
}

void main() {
    const uint place = push.firstPlace + gl_WorkGroupID.x;
    const uvec2 inArea = pixelAt(push.order, place);
    if (inArea.x >= areaWidth || inArea.y >= areaHeight) {
        return;
    }
    const uvec2 pixel = uvec2(areaLeft, areaTop) + inArea;
    const uint index = (place - push.bandPlace) * kTilePixels + gl_LocalInvocationIndex;
    FilmPixel sum = emptyPixel();
    LightParts lightSum = noLight();
    if (push.isFresh == 0u) {
        sum = film[index];
        if ((filmParts & kFilmLight) != 0u) {
            lightSum = filmLight[index];
        }
    }
    // A sample that the driver ends early is taken again, and counts once.
    PathSample taken = startSample(camera, settings, pixel.x, pixel.y, push.firstSample + sum.samples);
    bool isOn = sum.samples < push.samples;
    // Counts of the sample that is being taken, and of the turns of this invocation.
    uint steps = 0u;
    uint tests = 0u;
    uint turns = 0u;

    // Invariant: `sum` contains the first sum.samples samples of the block; `taken` is the one after them.
    do {
        if (isOn) {
            const Path path = taken.path;
            const Ray ray = makeRay(lattice, path.origin, 0.0, path.dir, kFarthest);
            InWay inWay;
            const Trace trace = traceOpaque(ray, false, taken.at, bounceDimension(path.bounce, kBounceAlpha),
                                            passing(settings, path), inWay);
            bool isWhole = trace.finished;
            steps += trace.steps;
            tests += trace.tests;
            ++taken.rays;
            if (trace.hit.triangleId == kNoTriangle) {
                taken = afterLeaving(taken, leaveScene(settings, path));
            } else {
                const TriangleRecord triangle = loadTriangle(trace.recordIndex);
                const float t = hitDistance(ray, trace.hit);
                const PathStep step = meetSurface(settings, path, ray, t, triangle, inWay, taken.at);
                taken = afterStep(camera, taken, step, t, trace.hit.triangleId);
                isWhole = isWhole && step.isWhole;
                if (hasFeature(kFeatureLights) && step.shadow.isNeeded) {
                    const ShadowRay shadow = step.shadow;
                    const Ray toLight = makeRay(lattice, shadow.origin, 0.0, shadow.dir, shadow.tMax);
                    InWay ofLight;
                    const Trace blocker =
                        traceOpaque(toLight, true, taken.at, bounceDimension(path.bounce, kBounceLightAlpha),
                                    shadowPassing(settings, step.path), ofLight);
                    isWhole = isWhole && blocker.finished;
                    steps += blocker.steps;
                    tests += blocker.tests;
                    ++taken.shadowRays;
                    taken = afterShadow(taken, shadow.gain, ofLight);
                }
            }
            if (isWhole && !taken.path.isAlive) {
                taken.steps = float(steps);
                taken.tests = float(tests);
                steps = 0u;
                tests = 0u;
                if ((filmParts & kFilmHits) != 0u) {
                    firstHits[index * kBlockSamples + sum.samples] = taken.first.triangleId;
                }
                if ((filmParts & kFilmLight) != 0u) {
                    lightSum = endSampleLight(lightSum, taken);
                }
                sum = endSample(sum, taken);
                taken = startSample(camera, settings, pixel.x, pixel.y, push.firstSample + sum.samples);
            }
            ++turns;
            isOn = isWhole && sum.samples < push.samples && turns < push.turns;
        }
    } while (isOn);

    FilmPixel was = emptyPixel();
    if (push.isFresh == 0u) {
        was = film[index];
    }
    ADD_COUNT(status.rays, sum.rays + sum.shadowRays - was.rays - was.shadowRays);
    ADD_COUNT(status.steps, uint(sum.steps - was.steps));
    ADD_COUNT(status.tests, uint(sum.tests - was.tests));
    film[index] = sum;
    if (push.isFresh != 0u && push.firstSample == 0u) {
        total[index].samples = 0u;
    }
    if ((filmParts & kFilmLight) != 0u) {
        filmLight[index] = lightSum;
    }
    if (sum.samples < push.samples) {
        atomicAdd(status.unfinished, 1u);
        atomicAdd(status.outOfTurns, turns >= push.turns ? 1u : 0u);
        atomicAdd(status.stuck, sum.samples == was.samples ? 1u : 0u);
    }
}
