// SPDX-License-Identifier: MIT
// Loads the records of the meta table's leaves.
#ifndef METAMARCH_LIB_REFERENCE_BOXES_GLSL
#define METAMARCH_LIB_REFERENCE_BOXES_GLSL
#include "lib/leaves.glsl"
#include "shared/reference_box.h"

LeafHead loadHead(const uint record) {
    const uvec4 words = LOAD4(leafWords, record);
    return LeafHead(words.x, words.y, words.z, words.w);
}

LeafFrame loadFrame(const uint record) {
    const uvec4 words = LOAD4(leafWords, frameEntry(record));
    return LeafFrame(words.x, words.y, words.z, words.w);
}

uvec4 loadBoxes(const uint group) { return LOAD4(leafWords, group); }

// Returns the index of the triangle record of a leaf's i-th reference.
uint loadTriangleIndex(const uint firstIndices, const uint i) {
    return oneOf(LOAD4(leafWords, firstIndices + (i >> 2u)), i);
}
#endif
