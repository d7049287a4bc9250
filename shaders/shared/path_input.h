// SPDX-License-Identifier: MIT
// What the kernel `path` is told.
#ifndef METAMARCH_SHARED_PATH_INPUT_H
#define METAMARCH_SHARED_PATH_INPUT_H
#include "camera.h"
#include "path_settings.h"

SHARED_BEGIN

// What is the same for all invocations.
struct PathInput {
    Camera camera;
    PathSettings settings;
};

// Pixels are worked on in tiles of kTilePixels (primary.h).
struct PathPush {
    uint firstTile;
    uint tilesPerRow;
    uint endSample; // each pixel takes its samples up to this one
    uint bandTile;  // the film on the device starts with this one
    uint isFresh;   // 1: whatever the film holds of these pixels is not theirs
};

// What a dispatch has done, all of its pixels together; zeros before it.
struct PathStatus {
    // Pixels that want another dispatch: a driver that limits the turns of loops may end an invocation before
    // it has come to endSample.
    uint unfinished;
    uint stuck; // those of them that came no further in this one
    uint rays;  // shadow rays, too
    uint steps; // of all rays; rounded down for each pixel
    uint tests;
};

SHARED_ASSERT_SIZE(PathStatus, 20)
SHARED_ASSERT_SIZE(PathInput, 208)
SHARED_ASSERT_OFFSET(PathInput, settings, 128)
SHARED_ASSERT_SIZE(PathPush, 20)

SHARED_END
#endif
