// EXT_meshopt_compression, and KHR_meshopt_compression as far as it is the same.
#pragma once
#include "scene/gltf_document.h"

namespace metamarch {

// Whether metamarch was built with meshoptimizer.
bool canDecompressMeshopt();

// Puts every compressed buffer view over a buffer of its own. Throws Error(sceneRefused) for data that cannot
// be decoded, and for a size that so few bytes cannot decode to. Does nothing without meshoptimizer.
void decompressMeshopt(GltfDocument& document, const SceneFile& file);

// The extension of a buffer or buffer view, by either name.
const nlohmann::json* meshoptExtension(const nlohmann::json& element);

} // namespace metamarch
