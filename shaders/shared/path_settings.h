// SPDX-License-Identifier: MIT
// What a path tracer is asked for, and what it needs to know of the scene as a whole.
#ifndef METAMARCH_SHARED_PATH_SETTINGS_H
#define METAMARCH_SHARED_PATH_SETTINGS_H
#include "interop.h"

SHARED_BEGIN

const uint kBindPathStatus = 44u;

// PathSettings::strategies. Both, weighted against each other, by default; each alone converges to the same
// picture, which tests use.
const uint kSampleLights = 1u;
const uint kSampleBsdf = 2u;

struct PathSettings {
    vec3 background; // radiance from everywhere where there is no environment map
    uint maxBounces; // direct light at the first hit is bounce 0
    uint seed;
    uint strategies;
    uint lightCount; // emitters, punctual lights, and 1 for an environment map
    uint emitterCount;
    uint punctualCount;
    uint environmentWidth;
    uint environmentHeight;
    float environmentProbability; // that light sampling chooses it
    float environmentCosine;      // of its rotation around y
    float environmentSine;
    float environmentScale;
    float clampLuminance; // of what one bounce adds to a sample; 0: no limit
    uint sunIndex;        // of the punctual light that rays see, a kLightDisc; kNoSun: none
    uint padding0;
    uint padding1;
    uint padding2;
};
const uint kNoSun = 0xffffffffu;

SHARED_ASSERT_SIZE(PathSettings, 80)
SHARED_ASSERT_OFFSET(PathSettings, maxBounces, 12)
SHARED_ASSERT_OFFSET(PathSettings, seed, 16)
SHARED_ASSERT_OFFSET(PathSettings, environmentWidth, 36)
SHARED_ASSERT_OFFSET(PathSettings, sunIndex, 64)

SHARED_END
#endif
