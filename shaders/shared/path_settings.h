// SPDX-License-Identifier: MIT
// The settings of the path tracer, and the facts about the whole scene that it needs.
#ifndef METAMARCH_SHARED_PATH_SETTINGS_H
#define METAMARCH_SHARED_PATH_SETTINGS_H
#include "media.h"

SHARED_BEGIN

const uint kBindPathStatus = 44u;

// Bits of PathSettings::strategies. By default both are used, with multiple importance sampling. Each alone
// converges to the same picture; tests rely on that.
const uint kSampleLights = 1u;
const uint kSampleBsdf = 2u;
// The camera does not see what is all around; it lights the scene all the same.
const uint kHideSurroundings = 4u;

struct PathSettings {
    vec3 background; // radiance from all directions, if there is no environment map
    uint maxBounces; // direct light at the first hit is bounce 0
    uint seed;
    uint strategies;
    // Number of entries of the table of lights: one for each emitter, or with kFeatureLightTree one for the
    // whole tree; one for each punctual light; one for the environment map.
    uint lightCount;
    uint emitterCount;
    uint punctualCount;
    uint environmentWidth;
    uint environmentHeight;
    float environmentProbability; // probability that light sampling chooses the map
    float environmentCosine;      // of the map's rotation around y
    float environmentSine;
    float environmentScale;
    float clampLuminance;  // largest luminance of one contribution to a sample: see clampedGain; 0: no limit
    uint sunIndex;         // index of the kLightDisc among the punctual lights, which rays see; kNoSun: none
    Media eyeMedia;        // what the camera's eye is inside of
    uint blockColumnShift; // log2 of the columns of cells in a block of the map
    uint blockRowShift;
    uint catcher;       // with kFeatureCatcher, the material of the shadow catcher's surfaces
    uint catcherWhite;  // the material by which they measure shadow
    uint catcherMirror; // the material by which they mirror objects; kNoCatcher: they do not
    uint padding0;
    uint padding1;
};
const uint kNoSun = 0xffffffffu;
const uint kNoCatcher = 0xffffffffu;

SHARED_ASSERT_SIZE(PathSettings, 112)
SHARED_ASSERT_OFFSET(PathSettings, maxBounces, 12)
SHARED_ASSERT_OFFSET(PathSettings, seed, 16)
SHARED_ASSERT_OFFSET(PathSettings, environmentWidth, 36)
SHARED_ASSERT_OFFSET(PathSettings, sunIndex, 64)
SHARED_ASSERT_OFFSET(PathSettings, eyeMedia, 68)
SHARED_ASSERT_OFFSET(PathSettings, catcher, 92)

SHARED_END
#endif
