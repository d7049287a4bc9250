// EXT_meshopt_compression, and KHR_meshopt_compression as far as it is the same.
#pragma once
#include "metamarch/scene/gltf/document.h"

namespace metamarch {

// Whether metamarch was built with meshoptimizer.
bool canDecompressMeshopt();

// Puts every compressed buffer view over a buffer of its own. Throws Error(inputRefused) for data that cannot
// be decoded, and for a size that so few bytes cannot decode to. Does nothing without meshoptimizer.
void decompressMeshopt(GltfDocument& document, const InputFile& file);

// The extension of a buffer or buffer view, by either name.
const nlohmann::json* meshoptExtension(const nlohmann::json& element);

} // namespace metamarch
