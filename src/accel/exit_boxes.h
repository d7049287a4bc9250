// SPDX-License-Identifier: MIT
// Exit boxes: how far a ray may advance once it has tested a leaf.
#pragma once
#include "metamarch/accel/leaf_list.h"
#include "metamarch/accel/meta_table.h"

namespace metamarch {

// Grows the box of each leaf in the table over those neighbouring leaves whose triangles are all listed in
// the leaf itself (empty neighbours qualify). The boxes may then overlap; each cell still names a single leaf
// to test. `table` must have been built from `list`. Runs in parallel; the result does not depend on the
// number of threads.
// A. Pérard-Gayot, J. Kalojanov, P. Slusallek, "GPU Ray Tracing using Irregular Grids", Eurographics 2017,
// section 4.3, which does the same for grid cells.
//
// Why no hit is lost: if a triangle comes within kReferenceMargin of the exit box, it comes within that
// distance of some cell of the box. The leaf that owns the cell lists the triangle, and therefore so does the
// leaf that was tested.
void growExitBoxes(const LeafList& list, MetaTable& table);

} // namespace metamarch
