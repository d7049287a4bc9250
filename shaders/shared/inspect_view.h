// SPDX-License-Identifier: MIT
// The views that make the algorithm visible, and what their kernels, `inspect` and `cells`, have in common.
#ifndef METAMARCH_SHARED_INSPECT_VIEW_H
#define METAMARCH_SHARED_INSPECT_VIEW_H
#include "camera.h"
#include "triangle.h"

SHARED_BEGIN

// InspectPush::view. Each has a row in host/render/view_names.h and a colour in inspect.h or cells.h.
const uint kViewSteps = 0u;          // look-ups or nodes visited
const uint kViewTests = 1u;          // triangle tests
const uint kViewDepth = 2u;          // along the view axis
const uint kViewNormals = 3u;        // geometric, to the front of the triangle
const uint kViewShadingNormals = 4u; // with normal map, to the side of the eye
const uint kViewUvs = 5u;            // the first set of texture coordinates
const uint kViewAlbedo = 6u;         // base colour
const uint kViewTriangleId = 7u;
const uint kViewMaterialId = 8u;
// What the table knows of the place that was hit.
const uint kViewLeafId = 9u;
const uint kViewCellBorders = 10u; // lattice planes, and where they divide leaves
const uint kViewExitBoxes = 11u;   // of the leaf

struct InspectPush {
    uint firstTile; // of kTilePixels (primary.h), numbered in rows
    uint tilesPerRow;
    uint view;
    float scaleMax; // positive: the count of the hottest colour, or where depth is black, in world units
};

// Pixels, packed as packedPixel does.
const uint kMissColor = 0xff2b2725u;       // the ray met nothing
const uint kUnfinishedColor = 0xffff00ffu; // the driver ended the trace: there is no result

// What a trace of a camera ray found.
struct Inspected {
    CameraRay view;
    Ray ray; // made of it
    Hit hit;
    uint steps; // kCutShort: the trace is not finished
    uint tests;
};

SHARED_ASSERT_SIZE(InspectPush, 16)
SHARED_ASSERT_OFFSET(InspectPush, view, 8)
SHARED_ASSERT_OFFSET(InspectPush, scaleMax, 12)

SHARED_END
#endif
