// SPDX-License-Identifier: MIT
// Camera rays; host and device share this definition.
#ifndef METAMARCH_SHARED_CAMERA_H
#define METAMARCH_SHARED_CAMERA_H
#include "environment_map.h"
#include "features.h"
#include "math.h"

SHARED_BEGIN

// Values of Camera::projection.
const uint kProjectionLinear = 0u;
const uint kProjectionPanorama = 1u;

// Values of Camera::pixelFilter: how a pixel's samples are spread around its centre, on each axis
// independently.
const uint kFilterBox = 0u;            // uniform over the pixel
const uint kFilterTent = 1u;           // falls linearly to 0 at the centre of the next pixel
const uint kFilterBlackmanHarris = 2u; // bell-shaped, 0 from 1.5 pixels on: kBlackmanHarrisWidth

// Linear camera: perspective if the eye steps are zero, orthographic if the direction steps are zero. The
// steps lead from the centre of the picture to its right and lower edges. `forward` has unit length and is
// perpendicular to the steps.
// Panorama: shows all directions around `eye` in the layout of environment_map.h, with +x forward, +y up and
// +z to the right. The direction steps have unit length.
struct Camera {
    vec3 eye;
    uint width; // pixels
    vec3 forward;
    uint height;
    vec3 eyeRight;
    uint projection;
    vec3 eyeDown;
    uint pixelFilter;
    vec3 dirRight;
    float inverseFocus; // 1 / distance of the plane in focus along `forward`, in world units
    vec3 dirDown;
    uint padding0;
    // Length is the radius of the thin lens in world units; 0: a pinhole, as for every panorama.
    vec3 lensRight;
    uint padding1;
    vec3 lensDown;
    uint padding2;
};

struct CameraRay {
    vec3 origin;
    vec3 dir; // unit length
};

SHARED_FN bool hasLens(const Camera camera) {
    return hasFeature(kFeatureLens) && dotProduct(camera.lensRight, camera.lensRight) > 0.0f;
}

SHARED_FN bool isPanorama(const Camera camera) {
    return hasFeature(kFeaturePanorama) && camera.projection == kProjectionPanorama;
}

// Returns the features that a kernel needs for this camera.
SHARED_FN uint cameraFeatures(const Camera camera) {
    return (hasLens(camera) ? kFeatureLens : 0u) | (isPanorama(camera) ? kFeaturePanorama : 0u) |
           (camera.pixelFilter != kFilterBox ? kFeatureWideFilter : 0u);
}

// Returns the pinhole ray of a linear camera through the centre of pixel (x, y); (0, 0) is top left.
SHARED_FN CameraRay cameraRay(const Camera camera, const uint x, const uint y) {
    const float right = (float(x) + 0.5f) / float(camera.width) * 2.0f - 1.0f;
    const float down = (float(y) + 0.5f) / float(camera.height) * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    return CameraRay(origin, unitVector(dir));
}

// Returns the ray through a point of the picture, in pixels from its upper left corner, and a point of the
// lens, in lens radii. Points outside the picture are allowed.
SHARED_FN CameraRay cameraRayThrough(const Camera camera, const vec2 place, const vec2 lens) {
    const vec2 part = vec2(place.x / float(camera.width), place.y / float(camera.height));
    if (isPanorama(camera)) {
        const vec3 around = mapDirection(part);
        const vec3 dir = camera.forward * around.x - camera.dirDown * around.y + camera.dirRight * around.z;
        return CameraRay(camera.eye, unitVector(dir));
    }
    const float right = part.x * 2.0f - 1.0f;
    const float down = part.y * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    if (!hasLens(camera)) {
        return CameraRay(origin, unitVector(dir));
    }
    // All points of the lens see the same point of the plane in focus.
    const vec3 onLens = camera.lensRight * lens.x + camera.lensDown * lens.y;
    return CameraRay(origin + onLens, unitVector(dir - onLens * camera.inverseFocus));
}

// Returns the ray through the centre of pixel (x, y) from the centre of the lens.
SHARED_FN CameraRay centerRay(const Camera camera, const uint x, const uint y) {
    return cameraRayThrough(camera, vec2(float(x) + 0.5f, float(y) + 0.5f), vec2(0.0f));
}

// The window with four terms and -92 dB from F. J. Harris, "On the Use of Windows for Harmonic Analysis with
// the Discrete Fourier Transform", 1978, divided by its first term. Cycles filters with it, 3 pixels wide.
const float kBlackmanHarrisWidth = 3.0f; // pixels
const float kBlackmanHarris1 = 1.36108711f;
const float kBlackmanHarris2 = 0.393811847f;
const float kBlackmanHarris3 = 0.0325574913f;
// In exact arithmetic, four steps from the start value below end within 1e-6 pixels.
const uint kBlackmanHarrisSteps = 4u;

// Maps u in [0, 1) to [-1.5, 1.5] pixels.
SHARED_FN float sampleBlackmanHarris(const float u) {
    const float share = abs(u - 0.5f); // fraction of the samples between the centre and the wanted distance
    // Newton's method for that distance, in units of the filter's width. The share is a concave function of
    // the distance, so the iterates approach it from below.
    float distance = 0.4994f * (1.0f - sqrt(sqrt(1.0f - 2.0f * share)));
    for (uint i = 0u; i < kBlackmanHarrisSteps; ++i) {
        const vec2 circle = circlePoint(distance);
        const float cosine = circle.x;
        const float square = cosine * cosine;
        const float sines = kBlackmanHarris1 + kBlackmanHarris2 * cosine +
                            kBlackmanHarris3 * (4.0f * square - 1.0f) * (1.0f / 3.0f);
        const float inside = distance + circle.y * sines * (0.5f * kInvPi);
        const float density = 1.0f + kBlackmanHarris1 * cosine + kBlackmanHarris2 * (2.0f * square - 1.0f) +
                              kBlackmanHarris3 * (4.0f * square - 3.0f) * cosine;
        distance = min(distance + (share - inside) / density, 0.5f);
    }
    return (u < 0.5f ? -distance : distance) * kBlackmanHarrisWidth;
}

// Maps u in [0, 1) to (-1, 1) pixels; u = 0 maps to -1.
SHARED_FN float sampleTent(const float u) {
    // Distance to the tent's end; half its square is the area beyond the sample.
    const float side = sqrt(1.0f - 2.0f * abs(u - 0.5f));
    return u < 0.5f ? side - 1.0f : 1.0f - side;
}

// Returns an offset from the pixel's centre, in pixels.
SHARED_FN vec2 sampleFilter(const uint pixelFilter, const vec2 u) {
    if (hasFeature(kFeatureWideFilter) && pixelFilter == kFilterBlackmanHarris) {
        return vec2(sampleBlackmanHarris(u.x), sampleBlackmanHarris(u.y));
    }
    if (hasFeature(kFeatureWideFilter) && pixelFilter == kFilterTent) {
        return vec2(sampleTent(u.x), sampleTent(u.y));
    }
    return vec2(u.x - 0.5f, u.y - 0.5f);
}

// Returns a point of the unit disc, uniform in area: concentric squares map to concentric circles. P.
// Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", 1997.
SHARED_FN vec2 sampleDisc(const vec2 u) {
    const float x = u.x * 2.0f - 1.0f;
    const float y = u.y * 2.0f - 1.0f;
    const bool isWide = abs(x) > abs(y);
    const float radius = isWide ? x : y;
    // Angle from the axis, in eighths of a turn.
    const float eighths = (isWide ? y : x) / (radius == 0.0f ? 1.0f : radius);
    const vec2 circle = circlePoint(isWide ? 0.125f * eighths : 0.25f - 0.125f * eighths);
    return vec2(circle.x * radius, circle.y * radius);
}

// Returns a ray of pixel (x, y), sampled from its filter and its lens; all rays have equal weight. The random
// numbers are in [0, 1).
SHARED_FN CameraRay sampleCameraRay(const Camera camera, const uint x, const uint y, const vec2 uFilter,
                                    const vec2 uLens) {
    const vec2 offset = sampleFilter(camera.pixelFilter, uFilter);
    const vec2 place = vec2(float(x) + 0.5f + offset.x, float(y) + 0.5f + offset.y);
    vec2 lens = vec2(0.0f);
    if (hasLens(camera)) {
        lens = sampleDisc(uLens);
    }
    return cameraRayThrough(camera, place, lens);
}

SHARED_ASSERT_SIZE(Camera, 128)
SHARED_ASSERT_OFFSET(Camera, width, 12)
SHARED_ASSERT_OFFSET(Camera, forward, 16)
SHARED_ASSERT_OFFSET(Camera, height, 28)
SHARED_ASSERT_OFFSET(Camera, eyeRight, 32)
SHARED_ASSERT_OFFSET(Camera, projection, 44)
SHARED_ASSERT_OFFSET(Camera, eyeDown, 48)
SHARED_ASSERT_OFFSET(Camera, pixelFilter, 60)
SHARED_ASSERT_OFFSET(Camera, dirRight, 64)
SHARED_ASSERT_OFFSET(Camera, inverseFocus, 76)
SHARED_ASSERT_OFFSET(Camera, dirDown, 80)
SHARED_ASSERT_OFFSET(Camera, lensRight, 96)
SHARED_ASSERT_OFFSET(Camera, lensDown, 112)

SHARED_END
#endif
