// SPDX-License-Identifier: MIT
// Loads the meta table's leaves with the boxes of their references. They share one array, so that leaf and
// frame share a cache line, and because devices have few bindings.
#ifndef METAMARCH_LIB_REFERENCE_BOXES_GLSL
#define METAMARCH_LIB_REFERENCE_BOXES_GLSL
#include "lib/leaves.glsl"
#include "shared/reference_box.h"

Leaf loadFramedLeaf(const uint leafId) { return loadLeaf(leafEntry(leafId)); }

LeafFrame loadFrame(const uint leafId) {
    const uvec4 words = LOAD4(leafWords, frameEntry(leafId));
    return LeafFrame(words.x, words.y, words.z, words.w);
}

uvec4 loadBoxes(const uint group) { return LOAD4(leafWords, group); }
#endif
