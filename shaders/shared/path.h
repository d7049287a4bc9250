// SPDX-License-Identifier: MIT
// The path tracer: follows a path from the camera, one surface at a time, with next-event estimation.
//
// Both light sampling and BSDF sampling find light. Multiple importance sampling combines them: E. Veach, L.
// Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995. The kernel and the CPU
// trace the rays; the rest of the estimator is here.
#ifndef METAMARCH_SHARED_PATH_H
#define METAMARCH_SHARED_PATH_H
#include "bsdf.h"
#include "film.h"
#include "media.h"
#include "ray_cone.h"
#include "scene_light.h"
#include "sobol.h"

SHARED_BEGIN

// Replaces a density if no other technique can find the direction.
const float kCertain = 1.0e30f;
// Russian roulette begins at this bounce. A path survives with a probability equal to the square root of its
// largest throughput. In a closed box and under an environment map this had the least error for its time.
// Compared were the throughput itself from bounces 1, 2 and 4, the square root from bounce 1, and no
// roulette.
const uint kFirstRoulette = 3u;
const float kLeastSurvival = 0.05f;

struct Path {
    vec3 origin;
    float pdf;   // of BSDF sampling for dir; kCertain for camera rays and deltas
    vec3 dir;    // unit length
    uint bounce; // number of surfaces met so far
    uint passes; // with kFeatureVolume, number of them that were no interface: see passSurface
    // With kFeatureThinGlass: number of panes that the path went straight through, and the length of the ray
    // before the last of them, back to the surface that scattered it. `pdf`, `bin` and `receiver` are that
    // surface's, because its light samples go through the panes too.
    uint panes;
    float behindPanes;
    vec3 throughput;
    float radianceScale; // contained in throughput: see BsdfSample
    vec3 radiance;
    vec3 gained;            // the part of radiance that the last surface or the surroundings added
    uint channel;           // colour channel that a dispersive volume has chosen; kNoChannel: none yet
    uint bin;               // of the surface that the ray has left, for the density of light sampling
    LightReceiver receiver; // with kFeatureLightTree, the surface that the ray has left: for the same density
    bool isAlive;
    RayCone cone; // used with kFeatureMipmaps
    Media media;  // used with kFeatureVolume
    // With kFeatureCatcher: the camera ray has met the shadow catcher. Then `radiance` is what the catcher,
    // which is white to this path, reflects, and the two vectors have the meaning that LightParts gives them.
    bool isCaught;
    bool isOfLamp; // the ray from the catcher has met a lamp: what it reflects is there without objects too
    vec3 unblocked;
    vec3 behind;
    bool isMirrored; // the path goes the way of the catcher's mirror, and `radiance` is what it finds there
    float mirrored;  // LightParts::mirrored of this path
};
const uint kNoChannel = 3u;
const float kLampPart = 0.5f; // see kindOf
// The part of the samples that follow the mirror, of those that meet a catcher which has one.
const float kMirrorPart = 0.5f;

// A ray to a light, and the radiance that the path gains if nothing occludes the light.
struct ShadowRay {
    vec3 origin;
    float tMax;
    vec3 dir; // if tMax is 1, the vector to the light; otherwise of unit length
    bool isNeeded;
    vec3 gain;
    bool isWhole; // as in PathStep
};

struct PathStep {
    Path path;
    ShadowRay shadow;
    vec3 albedo;
    vec3 normal;
    vec3 shadingNormal;
    bool isWhole; // false if the driver has ended a loop early
};

SHARED_FN Path startPath(const vec3 origin, const vec3 dir, const RayCone cone, const Media media) {
    return Path(origin, kCertain, dir, 0u, 0u, 0u, 0.0f, vec3(1.0f), 1.0f, vec3(0.0f), vec3(0.0f), kNoChannel,
                kAnyNormal, LightReceiver(vec3(0.0f), vec3(0.0f)), true, cone, media, false, false,
                vec3(0.0f), vec3(0.0f), false, 0.0f);
}

// Returns the number of surfaces that count as bounces: all that the path has met but panes.
SHARED_FN uint countedBounces(const Path path) {
    return hasFeature(kFeatureThinGlass) ? path.bounce - path.panes : path.bounce;
}

// Returns the number of surfaces that have scattered the path.
SHARED_FN uint scatterings(const Path path) {
    return hasFeature(kFeatureVolume) ? countedBounces(path) - path.passes : countedBounces(path);
}

// Returns true for a path, or a shadow ray of it, that is on its way from the shadow catcher which its camera
// ray has met, to measure shadow.
SHARED_FN bool isFromCatcher(const Path path) {
    return path.isCaught && path.bounce == 1u && !path.isMirrored;
}

// Returns true for a path that is on its way from the catcher to what the catcher mirrors.
SHARED_FN bool isFromMirror(const Path path) { return path.isMirrored && path.bounce == 1u; }

// What a ray meets: nothing that is there for it, an object, or a lamp.
const uint kNothing = 0u;
const uint kObject = 1u;
const uint kLamp = 2u; // with kFeatureCatcher; is there without objects too

// What is in the way of a ray. A ray that leaves the catcher goes on through objects until it meets a lamp or
// leaves the scene, so `last` may differ from `first`.
struct InWay {
    uint first;
    uint last;
    vec3 tint; // with kFeatureThinGlass: the part of the light that the panes in the way let through
};

SHARED_FN InWay nothingInWay() { return InWay(kNothing, kNothing, vec3(1.0f)); }

// Returns the first ray of a sample as a path.
SHARED_FN Path cameraPath(const Camera camera, const PathSettings settings, const uint x, const uint y,
                          const PixelSample at) {
    vec2 uLens = vec2(0.0f);
    if (hasLens(camera)) {
        uLens = sample2d(at, kDimensionLens);
    }
    const CameraRay view = sampleCameraRay(camera, x, y, sample2d(at, kDimensionFilter), uLens);
    return startPath(view.origin, view.dir, cameraCone(camera, view.dir), settings.eyeMedia);
}

// One sample of a pixel while its path is traced.
struct PathSample {
    PixelSample at;
    Path path;
    FirstHit first;
    LightParts light;
    uint rays; // traced so far, without shadow rays
    uint shadowRays;
    float steps; // of all rays
    float tests;
};

SHARED_FN PathSample startSample(const Camera camera, const PathSettings settings, const uint x, const uint y,
                                 const uint index) {
    const PixelSample at = makePixelSample(x, y, index, settings.seed);
    return PathSample(at, cameraPath(camera, settings, x, y, at), missFirst(), noLight(), 0u, 0u, 0.0f, 0.0f);
}

// Returns the distance of a hit from the origin of the ray that was given to makeRay.
SHARED_FN float hitDistance(const Ray ray, const Hit hit) { return ray.shift + hit.t; }

// Returns the sample after `step` at a triangle, which its path met at distance `t`.
SHARED_FN PathSample afterStep(const Camera camera, const PathSample arriving, const PathStep step,
                               const float t, const uint triangleId) {
    PathSample next = arriving;
    next.path = step.path;
    next.light = addLight(arriving.light, scatterings(arriving.path), step.path.gained);
    if (arriving.path.bounce == 0u && !step.path.isCaught) {
        const float depth = t * dotProduct(arriving.path.dir, camera.forward);
        next.first = FirstHit(step.albedo, t, step.normal, triangleId, step.shadingNormal, depth);
    }
    return next;
}

// Returns the sample after leaveScene has ended its path.
SHARED_FN PathSample afterLeaving(const PathSample arriving, const Path ended) {
    PathSample next = arriving;
    next.path = ended;
    next.light = addLight(arriving.light, scatterings(arriving.path), ended.gained);
    return next;
}

// Adds the light of a shadow ray with `inWay` in its way. It left the last surface that the path met.
SHARED_FN PathSample afterShadow(const PathSample lit, const vec3 gain, const InWay inWay) {
    PathSample next = lit;
    const bool isFree = inWay.first == kNothing;
    const vec3 left = hasFeature(kFeatureThinGlass) ? gain * inWay.tint : gain;
    if (isFree) {
        next.path.radiance = lit.path.radiance + left;
        next.light = addLight(lit.light, scatterings(lit.path), left);
    }
    if (hasFeature(kFeatureCatcher) &&
        (isFromCatcher(lit.path) ? inWay.last != kLamp : lit.path.isOfLamp && isFree)) {
        next.path.unblocked = lit.path.unblocked + left;
    }
    return next;
}

// Returns the radiance of a sample for the film. A sample of the catcher's shadow has none. If one of its
// sums is not sound, it has one that the film rejects.
SHARED_FN vec3 filmRadiance(const Path ended) {
    const bool isSound = isWithin(ended.radiance, kLargestRadiance) &&
                         isWithin(ended.unblocked, kLargestRadiance) &&
                         isWithin(ended.behind, kLargestRadiance);
    const vec3 sound = ended.isMirrored ? ended.radiance : vec3(0.0f);
    const vec3 ofCaught = isSound ? sound : vec3(2.0f * kLargestRadiance);
    return ended.isCaught ? ofCaught : ended.radiance;
}

// Adds a sample whose path has ended to the sums of its block.
SHARED_FN FilmPixel endSample(const FilmPixel sum, const PathSample ended) {
    FilmPixel added = addSample(sum, filmRadiance(ended.path), ended.first);
    added.rays = sum.rays + ended.rays;
    added.shadowRays = sum.shadowRays + ended.shadowRays;
    added.steps = sum.steps + ended.steps;
    added.tests = sum.tests + ended.tests;
    return added;
}

SHARED_FN LightParts endSampleLight(const LightParts sum, const PathSample ended) {
    const Path path = ended.path;
    LightParts light = ended.light;
    if (path.isMirrored) {
        light = mirroredLight(ended.light, path.mirrored, path.behind);
    } else if (path.isCaught) {
        light = caughtLight(path.radiance, path.unblocked, path.behind);
    }
    return addSampleLight(sum, filmRadiance(path), light);
}

// What a ray passes on its way. With kFeatureCatcher or kFeatureThinGlass.
struct Passing {
    uint material;       // its surfaces are not there; kNoCatcher: all are there
    bool isToLamps;      // the ray goes on through objects until it meets a lamp
    bool isThroughPanes; // the ray goes straight through smooth, thin glass
};

// Returns what the rays of `path` pass. The catcher neither shadows nor mirrors itself: the ground that it is
// laid over in the end has these shadows and mirror images already.
SHARED_FN Passing passing(SCENE_PARAMETER const PathSettings settings, const Path path) {
    const bool isPassed = isFromCatcher(path) || isFromMirror(path);
    return Passing(hasFeature(SCENE kFeatureCatcher) && isPassed ? settings.catcher : kNoCatcher,
                   hasFeature(SCENE kFeatureCatcher) && hasFeature(SCENE kFeatureEmission) &&
                       isFromCatcher(path),
                   false);
}

// Returns the same for the ray to a light from the surface that `path` has just left. To the catcher panes
// are objects.
SHARED_FN Passing shadowPassing(SCENE_PARAMETER const PathSettings settings, const Path path) {
    Passing passed = passing(SCENE settings, path);
    passed.isThroughPanes = hasFeature(SCENE kFeatureThinGlass) && !isFromCatcher(path);
    return passed;
}

// Returns the settings for light between an emitter and a surface. How bright a hidden emitter would be in a
// direction is known to light sampling alone, so it alone finds the emitters that the catcher sees.
SHARED_FN PathSettings emitterSettings(const PathSettings settings, const bool isOfCatcher) {
    PathSettings result = settings;
    if (hasFeature(kFeatureCatcher) && isOfCatcher) {
        result.strategies = settings.strategies & ~kSampleBsdf;
    }
    return result;
}

// Returns the weight of a technique with density `own` beside one with density `other`. The tables of the
// environment map leave to BSDF sampling what it finds anyway, for which the balance heuristic is best; for
// all other lights it has more noise.
SHARED_FN float misWeight(const float own, const float other, const bool isMap) {
    return isMap ? balanceHeuristic(own, other) : powerHeuristic(own, other);
}

// Returns the weight of light that BSDF sampling found with density `own`. `other` is the density with which
// light sampling finds it; it is 0 if light sampling cannot find it.
SHARED_FN float foundWeight(const PathSettings settings, const float own, const float other,
                            const bool isMap) {
    const bool isOnlyWay = other == 0.0f || own >= kCertain;
    const bool byLights = (settings.strategies & kSampleLights) != 0u;
    const bool byBsdf = (settings.strategies & kSampleBsdf) != 0u;
    return isOnlyWay || !byLights ? 1.0f : byBsdf ? misWeight(own, other, isMap) : 0.0f;
}

// Returns the weight of light that light sampling found with density `own`, which is 0 for lights that rays
// cannot hit. `other` is the density with which BSDF sampling finds it.
SHARED_FN float sampledWeight(const PathSettings settings, const float own, const float other,
                              const bool isMap) {
    const bool byBsdf = (settings.strategies & kSampleBsdf) != 0u;
    return own == 0.0f || !byBsdf ? 1.0f : misWeight(own, other, isMap);
}

// Limits the luminance of one contribution to settings.clampLuminance. It is not used for light that the
// camera sees directly.
SHARED_FN vec3 clampedGain(const PathSettings settings, const vec3 gain) {
    const float brightness = luminance(gain);
    const bool isOver = settings.clampLuminance > 0.0f && brightness > settings.clampLuminance;
    return isOver ? gain * (settings.clampLuminance / brightness) : gain;
}

// Returns what a triangle that was hit is for this path. A blended one is there with a probability equal to
// its coverage. `passed` is Passing::material.
//
// A lamp is a surface that light sampling knows, where it emits at least half of the most that its texture
// allows. Dark parts of an emissive texture, and unlit surfaces, are objects.
SHARED_FN uint kindOf(SCENE_PARAMETER const Ray ray, const TriangleRecord triangle, const PixelSample at,
                      const uint dimension, const uint passed) {
    const Surface surface = loadSurface(SCENE triangle.triangleId);
    const MaterialRecord record = loadMaterial(SCENE surface.material);
    const vec3 weights = cornerWeights(ray, triangle.v0, triangle.v1, triangle.v2);
    const TexturePoint uv = finestPoint(SCENE surface, weights);
    const float part = coverage(SCENE record, surface, weights, uv);
    const bool isPassed = hasFeature(SCENE kFeatureCatcher) && surface.material == passed;
    const bool isThere = !isPassed && (part >= 1.0f || sampleOf(at, dimension, triangle.triangleId) < part);
    const bool isLamp = hasFeature(SCENE kFeatureCatcher) && hasFeature(SCENE kFeatureEmission) &&
                        record.emissionDensity > 0.0f &&
                        largest(xyz(lookUp(SCENE record.emissionTexture, uv))) >= kLampPart;
    return !isThere ? kNothing : isLamp ? kLamp : kObject;
}

// Returns true for smooth glass without a volume: it lets light through in a straight line, or mirrors it.
SHARED_FN bool isPane(const Bsdf bsdf, const MaterialRecord record) {
    return hasFeature(kFeatureThinGlass) && bsdf.hasFacets && bsdf.isSmooth &&
           (record.flags & kSurfaceVolume) == 0u && largest(bsdf.throughColor) > 0.0f;
}

// Returns the part of the light that goes straight through a triangle along the ray; 0 if it is no pane.
SHARED_FN vec3 throughPane(SCENE_PARAMETER const Ray ray, const TriangleRecord triangle) {
    const Surface surface = loadSurface(SCENE triangle.triangleId);
    const MaterialRecord record = loadMaterial(SCENE surface.material);
    const vec3 weights = cornerWeights(ray, triangle.v0, triangle.v1, triangle.v2);
    const TexturePoint uv = finestPoint(SCENE surface, weights);
    const vec3 wo = -unitVector(ray.dir);
    const SurfaceFrame frame =
        surfaceFrame(SCENE record, surface, weights, uv, makeSurfacePoint(triangle, weights).normal, wo);
    const Bsdf bsdf = makeBsdf(
        surfaceMaterial(SCENE record, vertexColor(SCENE surface, weights), uv, record.ior), frame, wo);
    return isPane(bsdf, record) ? evaluateDirection(bsdf, -wo, kLobeSmoothBase).value : vec3(0.0f);
}

// Returns what is in the way of a ray that has met one more triangle. `before` is what was in its way before.
SHARED_FN InWay meetInWay(SCENE_PARAMETER const InWay before, const Ray ray, const TriangleRecord triangle,
                          const PixelSample at, const uint dimension, const Passing passed) {
    InWay inWay = before;
    inWay.last = kindOf(SCENE ray, triangle, at, dimension, passed.material);
    if (hasFeature(SCENE kFeatureThinGlass) && passed.isThroughPanes && inWay.last != kNothing) {
        const vec3 through = throughPane(SCENE ray, triangle);
        if (largest(through) > 0.0f) {
            inWay.tint = before.tint * through;
            inWay.last = kNothing;
        }
    }
    inWay.first = before.first == kNothing ? inWay.last : before.first;
    return inWay;
}

// Ends a path whose ray hits no triangle.
SHARED_FN Path leaveScene(SCENE_PARAMETER const PathSettings settings, const Path path) {
    const EnvironmentLight light = environmentLight(SCENE settings, path.dir, path.bin);
    vec3 gain = light.radiance * foundWeight(settings, path.pdf, light.pdf, true);
    if (hasFeature(SCENE kFeatureLights) && settings.sunIndex != kNoSun) {
        const LightRecord sun = loadLight(SCENE settings.sunIndex);
        const float probability =
            loadTableEntry(SCENE punctualEntry(SCENE settings, settings.sunIndex)).probability;
        const float density = probability / (kTwoPi * sun.scale);
        gain = gain + sun.strength *
                          (hitsDisc(sun, path.dir) ? foundWeight(settings, path.pdf, density, false) : 0.0f);
    }
    Path ended = path;
    const vec3 whole = path.throughput * gain;
    const bool isSeen = (settings.strategies & kHideSurroundings) == 0u;
    const bool isOfMirror = hasFeature(SCENE kFeatureCatcher) && isFromMirror(path);
    ended.gained = isOfMirror                   ? vec3(0.0f)
                   : scatterings(path) > 0u     ? clampedGain(settings, whole)
                   : isSeen || path.bounce > 0u ? whole
                                                : vec3(0.0f);
    ended.radiance = path.radiance + ended.gained;
    if (hasFeature(SCENE kFeatureCatcher) && (isFromCatcher(path) || path.isOfLamp)) {
        ended.unblocked = path.unblocked + ended.gained;
    }
    ended.isAlive = false;
    return ended;
}

// Returns true if the surface bounds a volume that refracts colours differently.
SHARED_FN bool isDispersive(const MaterialRecord record) {
    return hasFeature(kFeatureDispersion) && record.dispersion > 0.0f &&
           (record.flags & kSurfaceVolume) != 0u;
}

// Chooses the colour channel that a path keeps in dispersive volumes.
SHARED_FN Path chooseChannel(const Path path, const MaterialRecord record, const PixelSample at) {
    Path chosen = path;
    if (isDispersive(record) && path.channel == kNoChannel) {
        const float u = sample1d(at, bounceDimension(path.bounce, kBounceChannel));
        chosen.channel = min(uint(u * 3.0f), 2u);
        chosen.throughput = path.throughput * channelMask(chosen.channel);
    }
    return chosen;
}

// Returns the part of the light that the medium leaves after `distance`.
SHARED_FN vec3 transmittance(SCENE_PARAMETER const uint medium, const float distance) {
    vec3 left = vec3(1.0f);
    if (medium != kNoMedium) {
        const vec3 depth = loadMaterial(SCENE materialOf(medium)).absorption * distance;
        left = vec3(exponential(-depth.x), exponential(-depth.y), exponential(-depth.z));
    }
    return left;
}

// Returns true for a surface that scatters light from both sides.
SHARED_FN bool isTransmissive(const Bsdf bsdf) {
    const vec3 through = bsdf.throughColor + bsdf.diffuseThroughColor;
    return hasFeature(kFeatureTransmission | kFeatureDiffuseTransmission) && largest(through) > 0.0f;
}

// Returns the bin of a surface.
SHARED_FN uint lightBin(SCENE_PARAMETER const Bsdf bsdf) {
    if (!hasFeature(SCENE kFeatureEnvironment)) {
        return kAnyNormal;
    }
    return isTransmissive(bsdf) ? kAnyNormal : normalBin(bsdf.frame.normal);
}

// Returns what the tree of lights needs to know of a surface.
SHARED_FN LightReceiver lightReceiver(const Bsdf bsdf, const SurfacePoint point) {
    return LightReceiver(point.position, isTransmissive(bsdf) ? vec3(0.0f) : bsdf.frame.normal);
}

// `ahead` and `behind` are the media on the side of the path and on the other side of the surface.
SHARED_FN ShadowRay sampleLights(SCENE_PARAMETER const PathSettings settings, const Path path,
                                 const Bsdf bsdf, const SurfacePoint point, const LightReceiver to,
                                 const uint bin, const uint ahead, const uint behind, const PixelSample at) {
    const vec2 u = sample2d(at, bounceDimension(path.bounce, kBounceLight));
    const SceneLightSample light = sampleSceneLight(SCENE settings, to, bin, u);
    const BsdfValue found = evalBsdf(bsdf, light.wi);
    const PathSettings ofLight =
        emitterSettings(settings, path.isCaught && path.bounce == 0u && !light.isFar);
    const float weight = sampledWeight(ofLight, light.pdf, found.pdf, light.isMap);
    const vec3 origin = offsetPoint(point, light.wi);
    const vec3 dir = light.isFar ? light.wi : light.end - origin;
    vec3 arriving = light.arriving;
    // The surface of a volume hides far lights from its inside.
    if (hasFeature(SCENE kFeatureVolume) && !light.isFar) {
        const bool isThrough = dotProduct(light.wi, bsdf.frame.normal) < 0.0f;
        arriving = arriving * transmittance(SCENE isThrough ? behind : ahead, sqrt(dotProduct(dir, dir)));
    }
    const vec3 gain = clampedGain(settings, path.throughput * found.value * arriving * weight);
    const bool isNeeded =
        !bsdf.isDelta && largest(gain) > 0.0f && (settings.strategies & kSampleLights) != 0u;
    return ShadowRay(origin, light.isFar ? kFarthest : 1.0f, dir, isNeeded, gain, light.isWhole);
}

SHARED_FN ShadowRay noShadow() { return ShadowRay(vec3(0.0f), 0.0f, vec3(0.0f), false, vec3(0.0f), true); }

// Returns the path after the surface, which it met at distance `t`, in a direction that is sampled from the
// BSDF. `width` is that of the cone at the surface.
SHARED_FN Path scatter(const Path path, const MaterialRecord record, const uint medium, const Bsdf bsdf,
                       const SurfacePoint point, const LightReceiver from, const uint bin, const float t,
                       const float width, const PixelSample at) {
    const BsdfSample drawn = sampleBsdf(bsdf, sample1d(at, bounceDimension(path.bounce, kBounceLobe)),
                                        sample2d(at, bounceDimension(path.bounce, kBounceDirection)));
    const float radianceScale = path.radianceScale * drawn.radianceScale;
    vec3 throughput = path.throughput * drawn.weight;

    // Russian roulette ignores the radiance scale, which is not a loss: light that leaves the glass regains
    // it.
    const float kept = largest(throughput) / radianceScale;
    const bool isRisked = path.bounce >= kFirstRoulette;
    const float survival = isRisked ? min(max(sqrt(kept), kLeastSurvival), 1.0f) : 1.0f;
    const bool survives = !isRisked || sample1d(at, bounceDimension(path.bounce, kBounceRoulette)) < survival;
    throughput = throughput / survival;

    Path next = path;
    next.origin = offsetPoint(point, drawn.wi);
    next.dir = drawn.wi;
    next.pdf = (drawn.flags & kSampleDelta) != 0u ? kCertain : drawn.pdf;
    next.throughput = throughput;
    next.radianceScale = radianceScale;
    next.bounce = path.bounce + 1u;
    next.bin = bin;
    next.receiver = from;
    next.isAlive = kept > 0.0f && survives;
    next.cone = scatteredCone(path.cone, width, next.pdf);
    if (hasFeature(kFeatureThinGlass)) {
        const bool isStraight = isPane(bsdf, record) && drawn.flags == (kSampleDelta | kSampleTransmitted) &&
                                !isFromCatcher(path);
        next.behindPanes = 0.0f;
        if (isStraight) {
            next.pdf = path.pdf;
            next.bin = path.bin;
            next.receiver = path.receiver;
            next.panes = path.panes + 1u;
            next.behindPanes = path.behindPanes + t;
        }
    }
    if (hasFeature(kFeatureVolume)) {
        const bool isCrossed =
            (drawn.flags & kSampleTransmitted) != 0u && (record.flags & kSurfaceVolume) != 0u;
        if (isCrossed) {
            next.media = crossSurface(path.media, medium, bsdf.frame.isBack != 0u);
        }
    }
    return next;
}

SHARED_FN float iorFor(const Path path, const MaterialRecord record) {
    return isDispersive(record) && path.channel != kNoChannel
               ? dispersedIor(record.ior, record.dispersion, path.channel)
               : record.ior;
}

// Takes the path through a surface that is no interface, in its direction. No light sample can find what is
// behind, because the surface occludes it. It counts as a bounce, so that every path ends.
SHARED_FN Path passSurface(const Path path, const uint medium, const bool isBack, const SurfacePoint point,
                           const float width) {
    Path next = path;
    next.origin = offsetPoint(point, path.dir);
    next.pdf = kCertain;
    next.bounce = path.bounce + 1u;
    next.passes = path.passes + 1u;
    next.cone = scatteredCone(path.cone, width, kCertain);
    next.media = crossSurface(path.media, medium, isBack);
    return next;
}

// Continues the path at `triangle`, which `ray` has hit at distance `t`. `ray` is made from the path.
SHARED_FN PathStep meetSurface(SCENE_PARAMETER const PathSettings settings, const Path arriving,
                               const Ray ray, const float t, const TriangleRecord triangle, const InWay inWay,
                               const PixelSample at) {
    const Surface surface = loadSurface(SCENE triangle.triangleId);
    const bool isCatcher =
        hasFeature(SCENE kFeatureCatcher) && arriving.bounce == 0u && surface.material == settings.catcher;
    const bool isMirror = isCatcher && settings.catcherMirror != kNoCatcher &&
                          sample1d(at, bounceDimension(0u, kBounceMirror)) < kMirrorPart;
    const uint ofCatcher = isMirror ? settings.catcherMirror : settings.catcherWhite;
    const MaterialRecord record = loadMaterial(SCENE isCatcher ? ofCatcher : surface.material);
    const vec3 weights = cornerWeights(ray, triangle.v0, triangle.v1, triangle.v2);
    const SurfacePoint point = makeSurfacePoint(triangle, weights);
    const float width = widthAt(arriving.cone, t);
    const TexturePoint uv =
        texturePoint(SCENE surface, weights, seenPart(triangle, arriving.dir, width, sampleIndex(at)),
                     sample1d(at, bounceDimension(arriving.bounce, kBounceLevel)));
    const vec3 wo = -arriving.dir;

    Path path = chooseChannel(arriving, record, at);
    float ior = iorFor(path, record);
    const uint medium = mediumOf(surface.material); // of a volume
    uint behind = kNoMedium;                        // the medium on the other side of the surface
    bool isPassed = false;
    if (hasFeature(SCENE kFeatureVolume)) {
        const bool isVolume = (record.flags & kSurfaceVolume) != 0u;
        const bool isBack = dotProduct(point.normal, wo) < 0.0f;
        if (isVolume && isBack && !isInside(path.media, medium)) {
            path.media = enclosedBy(path.media, medium);
        }
        path.throughput = path.throughput * transmittance(SCENE path.media.first, t);
        isPassed = isVolume && !isInterface(path.media, medium, isBack);
        behind = isVolume ? crossSurface(path.media, medium, isBack).first : path.media.first;
        const uint outside = mediumOutside(path.media, isBack);
        if (isVolume && outside != kNoMedium) {
            const float outsideIor = iorFor(path, loadMaterial(SCENE materialOf(outside)));
            ior = outsideIor > 0.0f ? ior / outsideIor : ior;
        }
    }
    const SurfaceFrame frame = surfaceFrame(SCENE record, surface, weights, uv, point.normal, wo);
    const SurfaceMaterial material =
        surfaceMaterial(SCENE record, vertexColor(SCENE surface, weights), uv, ior);
    const Bsdf bsdf = makeBsdf(material, frame, wo);

    const bool isUnlit = hasFeature(SCENE kFeatureUnlit) && (record.flags & kMaterialUnlit) != 0u;
    vec3 gain = vec3(0.0f);
    bool isWhole = true;
    if (hasFeature(SCENE kFeatureEmission)) {
        const float cosine = dotProduct(point.normal, wo);
        const bool isShown = cosine > 0.0f || (record.flags & kMaterialDoubleSided) != 0u;
        float probability = 0.0f;
        if (hasFeature(SCENE kFeatureLightTree) && record.emissionDensity > 0.0f && path.pdf < kCertain) {
            const EmitterChance chance = chanceOfEmitter(SCENE settings, path.receiver, triangle.triangleId);
            probability = chance.probability;
            isWhole = chance.isWhole;
        }
        const float distance = hasFeature(SCENE kFeatureThinGlass) ? path.behindPanes + t : t;
        const float density = solidAngleDensity(emitterDensity(SCENE record, triangle, probability),
                                                distance * distance, cosine);
        const vec3 emitted = record.emission * xyz(lookUp(SCENE record.emissionTexture, uv));
        gain = emitted *
               (isShown ? bsdf.emissionScale * foundWeight(emitterSettings(settings, isFromCatcher(path)),
                                                           path.pdf, density, false)
                        : 0.0f);
    }
    const vec3 shown = path.throughput * (isUnlit ? material.baseColor : gain);
    path.gained = isPassed ? vec3(0.0f) : scatterings(path) > 0u ? clampedGain(settings, shown) : shown;
    path.radiance = isPassed ? path.radiance : path.radiance + path.gained;
    if (hasFeature(SCENE kFeatureCatcher) && (isCatcher || isFromCatcher(path))) {
        const vec3 around = leaveScene(SCENE settings, arriving).gained;
        const vec3 ofLamp = inWay.first == kLamp ? path.gained : vec3(0.0f);
        const vec3 left = inWay.last == kLamp ? ofLamp : around;
        path.isOfLamp = !isCatcher && inWay.first == kLamp;
        path.unblocked = isCatcher ? path.unblocked : path.unblocked + left;
        path.behind = isCatcher ? around : path.behind;
        path.isCaught = true;
    } else if (hasFeature(SCENE kFeatureCatcher) && path.isOfLamp) {
        path.unblocked = path.unblocked + path.gained;
    }

    if (hasFeature(SCENE kFeatureCatcher)) {
        path.isMirrored = path.isMirrored || isMirror;
        path.mirrored = isFromMirror(path) ? largest(arriving.throughput) * kMirrorPart : path.mirrored;
    }

    // What the catcher mirrors looks as the camera would see it.
    const uint maxBounces = settings.maxBounces + (path.isMirrored ? 1u : 0u);
    const bool isLast = isUnlit || countedBounces(path) > maxBounces;
    const LightReceiver receiver = lightReceiver(bsdf, point);
    const uint bin = lightBin(SCENE bsdf);
    ShadowRay shadow = noShadow();
    if (hasFeature(SCENE kFeatureLights)) {
        shadow = sampleLights(SCENE settings, path, bsdf, point, receiver, bin, path.media.first, behind, at);
        shadow.isNeeded = shadow.isNeeded && !isLast && !isPassed && !isMirror;
    }
    Path next = scatter(path, record, medium, bsdf, point, receiver, bin, t, width, at);
    if (hasFeature(SCENE kFeatureVolume) && isPassed) {
        next = passSurface(path, medium, frame.isBack != 0u, point, width);
    }
    // A pane that is gone through is no bounce, so the path may go on behind its last one.
    const bool isThroughPane = hasFeature(SCENE kFeatureThinGlass) && !isUnlit && next.panes > path.panes;
    next.isAlive = next.isAlive && (isThroughPane || !isLast);
    if (hasFeature(SCENE kFeatureCatcher) && isMirror) {
        next.throughput = next.throughput / kMirrorPart;
        next.pdf = kCertain; // no light sample looks for what is in the mirror
    }
    const vec3 albedo = isUnlit ? material.baseColor : bsdf.albedo;
    return PathStep(next, shadow, albedo, point.normal, frame.normal, isWhole && shadow.isWhole);
}

SHARED_END
#endif
