// SPDX-License-Identifier: MIT
// The input and the status of the kernel `path`.
#ifndef METAMARCH_SHARED_PATH_INPUT_H
#define METAMARCH_SHARED_PATH_INPUT_H
#include "camera.h"
#include "path_settings.h"
#include "tile_order.h"

SHARED_BEGIN

// The input that is the same for all invocations. The film covers an area of the camera's picture; its tiles
// are those of the area.
struct PathInput {
    Camera camera;
    PathSettings settings;
    uint areaLeft; // in pixels of the camera's picture
    uint areaTop;
    uint areaWidth;
    uint areaHeight;
};

// A workgroup has one tile of kTilePixels pixels (tile_order.h).
struct PathPush {
    uint firstPlace;
    TileOrder order;
    uint firstSample; // number of the first sample of the block (film.h)
    uint samples;     // each pixel takes samples of the block until it has so many of them
    uint bandPlace;   // the first place of the film on the device
    uint isFresh;     // 1 if the block has no samples yet; its old content is then ignored
    uint turns; // an invocation ends after so many surfaces of its paths, so that no dispatch is endless
};

// The kernel `add_block` adds the complete blocks of some tiles to the blocks before them.
struct AddBlockPush {
    uint firstPlace; // counted from the first place of the film on the device
};

// low + 2^32 * high
struct Count {
    uint low;
    uint high;
};

// Sums over all pixels of a dispatch. The host sets them to zero before it.
struct PathStatus {
    // Number of pixels that still miss samples: PathPush::turns, or a driver that limits the turns of loops,
    // may end an invocation early. They need another dispatch.
    uint unfinished;
    uint stuck;      // number of those pixels that gained no sample
    uint outOfTurns; // number of those that PathPush::turns has ended
    Count rays;      // with shadow rays
    Count steps;     // of all rays; rounded down for each pixel
    Count tests;
};

SHARED_ASSERT_SIZE(PathStatus, 36)
SHARED_ASSERT_SIZE(PathInput, 256)
SHARED_ASSERT_OFFSET(PathInput, settings, 128)
SHARED_ASSERT_OFFSET(PathInput, areaLeft, 240)
SHARED_ASSERT_SIZE(PathPush, 40)
SHARED_ASSERT_SIZE(AddBlockPush, 4)

SHARED_END
#endif
