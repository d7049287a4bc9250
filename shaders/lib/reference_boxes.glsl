// SPDX-License-Identifier: MIT
// Loads the boxes of the references in the meta table's leaves.
#ifndef METAMARCH_LIB_REFERENCE_BOXES_GLSL
#define METAMARCH_LIB_REFERENCE_BOXES_GLSL
#include "lib/memory.glsl"
#include "shared/reference_box.h"

WORDS4(referenceBoxWords, kBindReferenceBoxes);

LeafFrame loadFrame(const uint leafId) {
    const uvec4 words = LOAD4(referenceBoxWords, leafId);
    return LeafFrame(words.x, words.y, words.z, words.w);
}

uvec4 loadBoxes(const uint group) { return LOAD4(referenceBoxWords, group); }
#endif
