// Camera rays, one definition for both sides.
#ifndef METAMARCH_SHARED_CAMERA_H
#define METAMARCH_SHARED_CAMERA_H
#include "environment_map.h"
#include "math.h"

SHARED_BEGIN

// Camera::projection.
const uint kProjectionLinear = 0u;
const uint kProjectionPanorama = 1u;

// Camera::pixelFilter: how the samples of a pixel are spread around its centre, in each axis by itself.
const uint kFilterBox = 0u;            // evenly, over the pixel
const uint kFilterTent = 1u;           // falling to 0 at the centre of the next pixel
const uint kFilterBlackmanHarris = 2u; // a bell, 0 from 1.5 pixels on: kBlackmanHarrisWidth

// A linear camera: perspective where the origin steps are zero, orthographic where the direction steps are.
// The steps lead from the centre of the picture to its right and lower edge. `forward` is of unit length and
// at right angles to the steps.
// A panorama: all directions around `eye` as environment_map.h lays them out, with +x forward, +y up and +z
// to the right; the direction steps are of unit length.
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
    float inverseFocus; // 1 / distance of the plane in focus, along `forward`, in world units
    vec3 dirDown;
    uint padding0;
    vec3 lensRight; // radius of the thin lens in world units, 0: a pinhole, as every panorama is
    uint padding1;
    vec3 lensDown;
    uint padding2;
};

struct CameraRay {
    vec3 origin;
    vec3 dir; // unit length
};

// The ray of a linear camera's pinhole through the centre of pixel (x, y); (0, 0) is top left.
SHARED_FN CameraRay cameraRay(const Camera camera, const uint x, const uint y) {
    const float right = (float(x) + 0.5f) / float(camera.width) * 2.0f - 1.0f;
    const float down = (float(y) + 0.5f) / float(camera.height) * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    return CameraRay(origin, unitVector(dir));
}

// The ray through a point of the picture, in pixels from its upper left corner, and a point of the lens, in
// its radii. Points beyond the picture's edges are fine.
SHARED_FN CameraRay cameraRayThrough(const Camera camera, const vec2 place, const vec2 lens) {
    const vec2 part = vec2(place.x / float(camera.width), place.y / float(camera.height));
    if (camera.projection == kProjectionPanorama) {
        const vec3 around = mapDirection(part);
        const vec3 dir = camera.forward * around.x - camera.dirDown * around.y + camera.dirRight * around.z;
        return CameraRay(camera.eye, unitVector(dir));
    }
    const float right = part.x * 2.0f - 1.0f;
    const float down = part.y * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    // All points of the lens see the same point of the plane in focus.
    const vec3 onLens = camera.lensRight * lens.x + camera.lensDown * lens.y;
    return CameraRay(origin + onLens, unitVector(dir - onLens * camera.inverseFocus));
}

// The ray through the centre of pixel (x, y), from the centre of the lens.
SHARED_FN CameraRay centerRay(const Camera camera, const uint x, const uint y) {
    return cameraRayThrough(camera, vec2(float(x) + 0.5f, float(y) + 0.5f), vec2(0.0f));
}

// F. J. Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform", 1978: the
// window of four terms and -92 dB, divided by the first. Cycles filters with it, 3 pixels wide.
const float kBlackmanHarrisWidth = 3.0f; // pixels
const float kBlackmanHarris1 = 1.36108711f;
const float kBlackmanHarris2 = 0.393811847f;
const float kBlackmanHarris3 = 0.0325574913f;
// In exact arithmetic four steps from the start below end within 1e-6 pixels.
const uint kBlackmanHarrisSteps = 4u;

// In [-1.5, 1.5] pixels, from u in [0, 1).
SHARED_FN float sampleBlackmanHarris(const float u) {
    const float share = abs(u - 0.5f); // of the samples, between the centre and the distance asked for
    // Newton's steps towards that distance, in widths. The share is concave in it, so they come from below.
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

// In (-1, 1) pixels, from u in [0, 1); 0 maps to -1.
SHARED_FN float sampleTent(const float u) {
    const float side = sqrt(1.0f - 2.0f * abs(u - 0.5f)); // of the square beside the sample
    return u < 0.5f ? side - 1.0f : 1.0f - side;
}

// An offset from the pixel's centre, in pixels.
SHARED_FN vec2 sampleFilter(const uint pixelFilter, const vec2 u) {
    if (pixelFilter == kFilterBlackmanHarris) {
        return vec2(sampleBlackmanHarris(u.x), sampleBlackmanHarris(u.y));
    }
    if (pixelFilter == kFilterTent) {
        return vec2(sampleTent(u.x), sampleTent(u.y));
    }
    return vec2(u.x - 0.5f, u.y - 0.5f);
}

// A point of the unit disc, uniform in its area: squares around the centre become circles.
// P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", 1997.
SHARED_FN vec2 sampleDisc(const vec2 u) {
    const float x = u.x * 2.0f - 1.0f;
    const float y = u.y * 2.0f - 1.0f;
    const bool isWide = abs(x) > abs(y);
    const float radius = isWide ? x : y;
    const float eighths = (isWide ? y : x) / (radius == 0.0f ? 1.0f : radius); // of a turn, from the axis
    const vec2 circle = circlePoint(isWide ? 0.125f * eighths : 0.25f - 0.125f * eighths);
    return vec2(circle.x * radius, circle.y * radius);
}

// A ray of pixel (x, y), drawn by its filter and from its lens: every one weighs the same. The numbers are in
// [0, 1).
SHARED_FN CameraRay sampleCameraRay(const Camera camera, const uint x, const uint y, const vec2 uFilter,
                                    const vec2 uLens) {
    const vec2 offset = sampleFilter(camera.pixelFilter, uFilter);
    const vec2 place = vec2(float(x) + 0.5f + offset.x, float(y) + 0.5f + offset.y);
    return cameraRayThrough(camera, place, sampleDisc(uLens));
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
