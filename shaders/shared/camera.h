// Camera rays and the `primary` integrator's pixel, one definition for both sides.
#ifndef METAMARCH_SHARED_CAMERA_H
#define METAMARCH_SHARED_CAMERA_H
#include "shared/math.h"

SHARED_BEGIN

// A linear camera: perspective where the origin steps are zero, orthographic where the direction steps are.
// The steps lead from the centre of the picture to its right and lower edge. `forward` is of unit length.
struct Camera {
    vec3 eye;
    uint width; // pixels
    vec3 forward;
    uint height;
    vec3 eyeRight;
    uint padding0;
    vec3 eyeDown;
    uint padding1;
    vec3 dirRight;
    uint padding2;
    vec3 dirDown;
    uint padding3;
};

struct CameraRay {
    vec3 origin;
    vec3 dir; // unit length
};

// The ray through the centre of pixel (x, y); (0, 0) is top left.
SHARED_FN CameraRay cameraRay(const Camera camera, const uint x, const uint y) {
    const float right = (float(x) + 0.5f) / float(camera.width) * 2.0f - 1.0f;
    const float down = (float(y) + 0.5f) / float(camera.height) * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    return CameraRay(origin, unitVector(dir));
}

// A ray through the pixel's square.
SHARED_FN CameraRay sampleCameraRay(const Camera camera, const uint x, const uint y, const vec2 uFilter,
                                    const vec2 uLens) {
    const float right = (float(x) + uFilter.x + 0.0f * uLens.x) / float(camera.width) * 2.0f - 1.0f;
    const float down = (float(y) + uFilter.y) / float(camera.height) * 2.0f - 1.0f;
    const vec3 origin = camera.eye + camera.eyeRight * right + camera.eyeDown * down;
    const vec3 dir = camera.forward + camera.dirRight * right + camera.dirDown * down;
    return CameraRay(origin, unitVector(dir));
}

SHARED_ASSERT_SIZE(Camera, 96)
SHARED_ASSERT_OFFSET(Camera, width, 12)
SHARED_ASSERT_OFFSET(Camera, forward, 16)
SHARED_ASSERT_OFFSET(Camera, height, 28)
SHARED_ASSERT_OFFSET(Camera, eyeRight, 32)
SHARED_ASSERT_OFFSET(Camera, eyeDown, 48)
SHARED_ASSERT_OFFSET(Camera, dirRight, 64)
SHARED_ASSERT_OFFSET(Camera, dirDown, 80)

SHARED_END
#endif
