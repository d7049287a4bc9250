// Exit boxes: how far a ray may go once it has tested a leaf.
#pragma once
#include "metamarch/accel/leaf_list.h"
#include "metamarch/accel/meta_table.h"

namespace metamarch {

// Grows the boxes of the table's leaves over neighbours whose triangles are all among the leaf's own, the
// empty ones included. Boxes then overlap; a cell still names the one leaf to test. The table is that of
// `list`. Parallel; the boxes do not depend on the number of threads.
// A. Pérard-Gayot, J. Kalojanov, P. Slusallek, "GPU Ray Tracing using Irregular Grids", Eurographics 2017,
// section 4.3, there over cells of the grid.
//
// No hit is lost: a triangle that comes within kReferenceMargin of the exit box comes within it of some cell
// there, so it is listed in the leaf that the cell belongs to, and with that in the leaf that was tested.
void growExitBoxes(const LeafList& list, MetaTable& table);

} // namespace metamarch
