// SPDX-License-Identifier: MIT
// The input and the status of the kernel `path`.
#ifndef METAMARCH_SHARED_PATH_INPUT_H
#define METAMARCH_SHARED_PATH_INPUT_H
#include "camera.h"
#include "path_settings.h"

SHARED_BEGIN

// The input that is the same for all invocations.
struct PathInput {
    Camera camera;
    PathSettings settings;
};

// A workgroup has one tile of kTilePixels pixels (primary.h).
struct PathPush {
    uint firstTile;
    uint tilesPerRow;
    uint endSample; // each pixel takes samples until it has this number
    uint bandTile;  // the first tile of the film on the device
    uint isFresh;   // 1 if these pixels have no samples yet; the film's old content is then ignored
};

// Sums over all pixels of a dispatch. The host sets them to zero before it.
struct PathStatus {
    // Number of pixels with fewer than endSample samples: a driver that limits the turns of loops may end an
    // invocation early. They need another dispatch.
    uint unfinished;
    uint stuck; // number of those pixels that gained no sample
    uint rays;  // with shadow rays
    uint steps; // of all rays; rounded down for each pixel
    uint tests;
};

SHARED_ASSERT_SIZE(PathStatus, 20)
SHARED_ASSERT_SIZE(PathInput, 224)
SHARED_ASSERT_OFFSET(PathInput, settings, 128)
SHARED_ASSERT_SIZE(PathPush, 20)

SHARED_END
#endif
