// SPDX-License-Identifier: MIT
// The kernels that turn films into the bytes of a screen: `resolve` makes pictures with 8 bits per channel,
// `present` composites such pictures at the screen's size, and `magnify` shows a part of the result.
#ifndef METAMARCH_SHARED_SCREEN_H
#define METAMARCH_SHARED_SCREEN_H
#include "tile_order.h"

SHARED_BEGIN

// The pictures of both kernels have one word per pixel, in rows from the top; the channels from the lowest
// byte up are red, green, blue and alpha, which is that of backdrop.h: 0 where there is nothing to show yet.
const uint kBindCoarse = 45u; // `present`'s binding of the lower picture

const uint kScreenTile = 64u; // pixels of a row that one workgroup of `present` writes

struct ResolvePush {
    uint firstPlace;
    TileOrder order;
    uint bandPlace; // the first place of the film in the buffers that are bound
    uint width;     // of the film, in pixels
    uint height;
    uint toneOperator; // tone_mapping.h
    float scale;       // factor of radiance
};

// `present` writes the columns [firstColumn, endColumn) of the screen.
struct PresentPush {
    uint width; // of the screen, in pixels
    uint height;
    uint firstColumn;
    uint endColumn;
    uint fineWidth; // of the upper picture
    uint fineHeight;
    uint coarseWidth; // of the lower picture, which is visible where the upper one is empty
    uint coarseHeight;
    uint isBlueFirst;     // 1 if the screen's lowest byte is blue
    uint backdropColumns; // texels of the backdrop, with kSpecBackdrop
    uint backdropRows;
};

// `magnify` shows a part of a picture that has the screen's size: each pixel as a block of scale x scale.
struct MagnifyPush {
    uint width; // of screen and picture, in pixels
    uint scale;
    uint skippedColumns; // of the screen, left of what it shows; at most width * scale - width
    uint skippedRows;
};

// Returns the pixel of the picture that `magnify` shows at pixel `i` of the screen, on one axis.
SHARED_FN uint magnifiedPixel(const uint i, const uint skipped, const uint scale) {
    return (i + skipped) / scale;
}

// Returns the pixel of a picture with `size` pixels that lies under pixel `i` of a screen with `screen`
// pixels, on one axis.
SHARED_FN uint pixelUnder(const uint i, const uint size, const uint screen) { return i * size / screen; }

SHARED_FN uint withBlueFirst(const uint pixel) {
    return (pixel & 0xff00ff00u) | ((pixel & 0xffu) << 16u) | ((pixel >> 16u) & 0xffu);
}

SHARED_ASSERT_SIZE(ResolvePush, 40)
SHARED_ASSERT_SIZE(PresentPush, 44)
SHARED_ASSERT_SIZE(MagnifyPush, 16)

SHARED_END
#endif
