// The path tracer, one invocation a pixel. Each turn of the loop takes a path to its next surface and on; a
// path that has ended makes place for the pixel's next sample at once, so that no invocation waits for its
// neighbours' longer paths, and no state of a path ever leaves the registers.
#include "lib/shading.glsl"
#include "lib/tiles.glsl"
#include "shared/film.h"
#include "shared/path.h"
#include "shared/path_input.h"

layout(std430, binding = kBindInput) readonly buffer InputBuffer {
    Camera camera;
    PathSettings settings;
};
layout(std430, binding = kBindOutput) buffer FilmBuffer { FilmPixel film[]; };
layout(std430, binding = kBindPathStatus) buffer StatusBuffer { PathStatus status; };
layout(push_constant) uniform PushBlock { PathPush push; };

// The closest triangle that is there for this path, or any.
Trace traceSolid(const Ray given, const bool anyHit, const PixelSample at, const uint dimension) {
    Trace trace = startTrace(given);
    if (!hasFeature(kFeatureAlpha)) {
        traverse(given, anyHit, trace);
        return trace;
    }
    Ray ray = given;
    bool isFound = false;
    do {
        // Under a condition: llvmpipe takes lanes that have left the loop through it again.
        if (!isFound) {
            Trace next = startTrace(ray);
            traverse(ray, false, next);
            next.steps += trace.steps;
            next.tests += trace.tests;
            trace = next;
            isFound = !next.finished || next.hit.triangleId == kNoTriangle;
            if (!isFound) {
                isFound = isThere(ray, loadTriangle(next.slot), at, dimension);
                ray.tMin = next.hit.t;
            }
        }
    } while (!isFound);
    return trace;
}

void main() {
    const uint tile = push.firstTile + gl_WorkGroupID.x;
    const uvec2 pixel = pixelOfTile(tile, push.tilesPerRow);
    if (pixel.x >= camera.width || pixel.y >= camera.height) {
        return;
    }
    const uint index = (tile - push.bandTile) * kTilePixels + gl_LocalInvocationIndex;
    FilmPixel sum = emptyPixel();
    if (push.isFresh == 0u) {
        sum = film[index];
    }
    PixelSample at = makePixelSample(pixel.x, pixel.y, sum.samples, settings.seed);
    Path path = cameraPath(camera, pixel.x, pixel.y, at);
    FirstHit first = missFirst();
    bool isOn = sum.samples < push.endSample;
    // Of the sample on its way: one that the driver ends is taken anew, and counts once.
    uint rays = 0u;
    uint shadowRays = 0u;
    float steps = 0.0;
    float tests = 0.0;

    // Holds here: `sum` has every sample before sum.samples, of which `path` is on its way.
    do {
        if (isOn) {
            const Ray ray = makeRay(lattice, path.origin, 0.0, path.dir, kFarthest);
            const Trace trace = traceSolid(ray, false, at, bounceDimension(path.bounce, kBounceAlpha));
            bool isWhole = trace.finished;
            steps += float(trace.steps);
            tests += float(trace.tests);
            ++rays;
            if (trace.hit.triangleId == kNoTriangle) {
                path = leaveScene(settings, path);
            } else {
                const TriangleRecord triangle = loadTriangle(trace.slot);
                const float t = ray.shift + trace.hit.t;
                const PathStep step = meetSurface(settings, path, ray, t, triangle, at);
                if (path.bounce == 0u) {
                    first = firstHit(step, camera.forward, path.dir, t, trace.hit.triangleId);
                }
                const uint bounce = path.bounce;
                path = step.path;
                if (hasFeature(kFeatureLights) && step.shadow.isNeeded) {
                    const ShadowRay shadow = step.shadow;
                    const Ray toLight = makeRay(lattice, shadow.origin, 0.0, shadow.dir, shadow.tMax);
                    const Trace blocker =
                        traceSolid(toLight, true, at, bounceDimension(bounce, kBounceLightAlpha));
                    isWhole = isWhole && blocker.finished;
                    steps += float(blocker.steps);
                    tests += float(blocker.tests);
                    ++shadowRays;
                    if (blocker.hit.triangleId == kNoTriangle) {
                        path.radiance += shadow.gain;
                    }
                }
            }
            if (isWhole && !path.isAlive) {
                sum = addSample(sum, path.radiance, first);
                sum.rays += rays;
                sum.shadowRays += shadowRays;
                sum.steps += steps;
                sum.tests += tests;
                rays = 0u;
                shadowRays = 0u;
                steps = 0.0;
                tests = 0.0;
                at = makePixelSample(pixel.x, pixel.y, sum.samples, settings.seed);
                path = cameraPath(camera, pixel.x, pixel.y, at);
                first = missFirst();
            }
            isOn = isWhole && sum.samples < push.endSample;
        }
    } while (isOn);

    FilmPixel was = emptyPixel();
    if (push.isFresh == 0u) {
        was = film[index];
    }
    atomicAdd(status.rays, sum.rays + sum.shadowRays - was.rays - was.shadowRays);
    atomicAdd(status.steps, uint(sum.steps - was.steps));
    atomicAdd(status.tests, uint(sum.tests - was.tests));
    film[index] = sum;
    if (sum.samples < push.endSample) {
        atomicAdd(status.unfinished, 1u);
        atomicAdd(status.stuck, sum.samples == was.samples ? 1u : 0u);
    }
}
