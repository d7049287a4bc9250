// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression.
#pragma once
#include "metamarch/scene/gltf/document.h"

namespace metamarch {

// Gives every compressed primitive accessors over its own decoded buffers, so that it reads like any other
// primitive: a triangle list with 32-bit indices. Throws Error(inputRefused) for data that Draco cannot
// decode or that does not fit the primitive's accessors.
void decompressDraco(GltfDocument& document, const InputFile& file);

} // namespace metamarch
