// From a film to the bytes of a screen, in two steps: `resolve` makes 8 bits of light, `present` lays such
// pictures over each other at the screen's size.
#ifndef METAMARCH_SHARED_SCREEN_H
#define METAMARCH_SHARED_SCREEN_H
#include "interop.h"

SHARED_BEGIN

// Pictures of both kernels are words in rows from the top: red, green, blue and alpha from the lowest byte
// up. Alpha is 0 where there is nothing to show yet.
const uint kBindCoarse = 45u; // of `present`: the picture below

const uint kScreenTile = 64u; // pixels of a row that one workgroup of `present` writes

struct ResolvePush {
    uint firstTile; // tiles are numbered in rows, as PathPush has them
    uint tilesPerRow;
    uint width; // of the film, in pixels
    uint height;
    uint toneOperator; // tone_mapping.h
    float scale;       // of radiance
};

// The columns [firstColumn, endColumn) of the screen.
struct PresentPush {
    uint width; // of the screen, in pixels
    uint height;
    uint firstColumn;
    uint endColumn;
    uint fineWidth; // of the picture on top
    uint fineHeight;
    uint coarseWidth; // of the one below, which shows where the fine one is empty
    uint coarseHeight;
    uint isBlueFirst; // 1: the screen's lowest byte is blue
};

// The pixel of a picture of `size` that lies under pixel `i` of a screen of `screen`, in one axis.
SHARED_FN uint pixelUnder(const uint i, const uint size, const uint screen) { return i * size / screen; }

SHARED_FN uint withBlueFirst(const uint pixel) {
    return (pixel & 0xff00ff00u) | ((pixel & 0xffu) << 16u) | ((pixel >> 16u) & 0xffu);
}

SHARED_ASSERT_SIZE(ResolvePush, 24)
SHARED_ASSERT_SIZE(PresentPush, 36)

SHARED_END
#endif
