// SPDX-License-Identifier: MIT
// The debug views, and the types that their kernels, `inspect` and `cells`, have in common.
#ifndef METAMARCH_SHARED_INSPECT_VIEW_H
#define METAMARCH_SHARED_INSPECT_VIEW_H
#include "camera.h"
#include "tile_order.h"
#include "triangle.h"

SHARED_BEGIN

// InspectPush::view. Each has a row in host/render/view_names.h and a colour in inspect.h or cells.h.
const uint kViewSteps = 0u;          // number of steps or node visits
const uint kViewTests = 1u;          // number of triangle tests
const uint kViewDepth = 2u;          // along the view axis
const uint kViewNormals = 3u;        // geometric normals, on the front of the triangle
const uint kViewShadingNormals = 4u; // with normal map, on the side of the eye
const uint kViewUvs = 5u;            // the first set of texture coordinates
const uint kViewAlbedo = 6u;         // base colour
// Parameters of glTF materials with their textures. A number from 0 to 1 is a grey of that part of 255.
const uint kViewMetallic = 7u;
const uint kViewRoughness = 8u;
const uint kViewEmissive = 9u; // emitted radiance; white is 1 and more
const uint kViewTransmission = 10u;
const uint kViewTriangleId = 11u;
const uint kViewMaterialId = 12u;
// Views of the meta table's content at the hit point.
const uint kViewLeafId = 13u;
const uint kViewCellBorders = 14u; // lattice planes, and where they divide leaves
const uint kViewExitBoxes = 15u;   // exit boxes of leaves
// The surface under a lamp at the eye: what a window shows while its camera moves.
const uint kViewHeadlight = 16u;

// Specialization constant of the kernel `inspect`: 1 draws the parameters of materials, 0 the other views.
// Drivers that run both sides of a branch would look up their textures for all views.
const uint kSpecParameters = 5u;

struct InspectPush {
    uint firstPlace;
    TileOrder order;
    uint view;
    float scaleMax; // the count with the hottest colour, or the depth that is black, in world units
    float scaleMin; // less than scaleMax; the depth that is white
};

// Colours in the format of packedPixel.
const uint kMissColor = 0x012b2725u;       // the ray met nothing; its alpha is kUncovered (backdrop.h)
const uint kUnfinishedColor = 0xffff00ffu; // the driver ended the trace: there is no result

// The result of tracing a camera ray.
struct Inspected {
    CameraRay view;
    Ray ray; // made from `view`
    Hit hit;
    uint steps; // kCutShort: the trace is not finished
    uint tests;
};

SHARED_ASSERT_SIZE(InspectPush, 32)
SHARED_ASSERT_OFFSET(InspectPush, view, 20)
SHARED_ASSERT_OFFSET(InspectPush, scaleMax, 24)
SHARED_ASSERT_OFFSET(InspectPush, scaleMin, 28)

SHARED_END
#endif
