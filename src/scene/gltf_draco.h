// KHR_draco_mesh_compression.
#pragma once
#include "scene/gltf_document.h"

namespace metamarch {

// Gives every compressed primitive accessors over buffers of its own, so that it reads like any other: a list
// of triangles with 32-bit indices. Throws Error(sceneRefused) for data that Draco cannot decode or that does
// not fit the primitive's accessors.
void decompressDraco(GltfDocument& document, const SceneFile& file);

} // namespace metamarch
