// SPDX-License-Identifier: MIT
// The driver's hierarchy. It has one box per triangle record; the primitive index is the record's index.
#ifndef METAMARCH_LIB_RAY_QUERY_GLSL
#define METAMARCH_LIB_RAY_QUERY_GLSL
#include "lib/scene.glsl"

layout(binding = kBindBoxes) uniform accelerationStructureEXT boxes;
#endif
