// SPDX-License-Identifier: MIT
// Samples a camera ray, on CPU and device.
#ifndef METAMARCH_TESTS_SHADING_CAMERA_CASE_H
#define METAMARCH_TESTS_SHADING_CAMERA_CASE_H
#include "metamarch/shared/camera.h"

SHARED_BEGIN

struct CameraCase {
    Camera camera;
    uint x;
    uint y;
    float uFilterX;
    float uFilterY;
    float uLensX;
    float uLensY;
    uint padding0;
    uint padding1;
};

struct CameraAnswer {
    vec3 origin;
    float filterX;
    vec3 dir;
    float filterY;
};

SHARED_FN CameraAnswer answer(const CameraCase asked) {
    const vec2 uFilter = vec2(asked.uFilterX, asked.uFilterY);
    const CameraRay ray =
        sampleCameraRay(asked.camera, asked.x, asked.y, uFilter, vec2(asked.uLensX, asked.uLensY));
    const vec2 offset = sampleFilter(asked.camera.pixelFilter, uFilter);
    return CameraAnswer(ray.origin, offset.x, ray.dir, offset.y);
}

SHARED_ASSERT_SIZE(CameraCase, 160)
SHARED_ASSERT_SIZE(CameraAnswer, 32)

SHARED_END
#endif
