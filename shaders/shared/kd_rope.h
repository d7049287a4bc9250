// SPDX-License-Identifier: MIT
// Ropes: for each face of each leaf, the smallest node that contains everything behind the face.
#ifndef METAMARCH_SHARED_KD_ROPE_H
#define METAMARCH_SHARED_KD_ROPE_H
#include "kd_walk.h"
#include "march.h"

SHARED_BEGIN

const uint kRopesPerLeaf = 6u;
const uint kNoRope = 0xffffffffu; // the face is on the border of the lattice

// Returns the index of a leaf's rope in the array of all ropes. `above` means the face with the larger
// coordinate.
SHARED_FN uint ropeIndex(const uint leafId, const uint axis, const bool above) {
    return leafId * kRopesPerLeaf + 2u * axis + (above ? 1u : 0u);
}

// Returns the index of the rope that leads from a leaf with the box [lo, hi) to `cell`, which is outside the
// box on exactly one axis.
SHARED_FN uint ropeTowards(const uint leafId, const ivec3 cell, const ivec3 lo, const ivec3 hi) {
    const uint axis = cell.x < lo.x || cell.x >= hi.x ? 0u : cell.y < lo.y || cell.y >= hi.y ? 1u : 2u;
    const bool above = cell.x >= hi.x || cell.y >= hi.y || cell.z >= hi.z;
    return ropeIndex(leafId, axis, above);
}

// Returns the child of an inner node that contains `cell`.
SHARED_FN uint childWithCell(const uint nodeId, const KdNode node, const ivec3 cell) {
    const uint axis = splitAxis(node);
    const int coordinate = axis == 0u ? cell.x : axis == 1u ? cell.y : cell.z;
    return coordinate < int(splitPlane(node)) ? nodeId + 1u : childAbove(node);
}

SHARED_END
#endif
