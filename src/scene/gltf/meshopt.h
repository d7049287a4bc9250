// SPDX-License-Identifier: MIT
// EXT_meshopt_compression and KHR_meshopt_compression.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/element.h"

#include <optional>

namespace metamarch {

// Whether metamarch was built with meshoptimizer.
bool canDecompressMeshopt();

// Decodes every compressed buffer view into a buffer of its own. Throws Error(inputRefused) for data that
// cannot be decoded, and for a decoded size that so few bytes cannot produce. Does nothing without
// meshoptimizer.
void decompressMeshopt(GltfDocument& document, const InputFile& file);

// Returns the extension of a buffer or buffer view, under either of its names.
std::optional<GltfElement> meshoptExtension(const GltfElement& element);

} // namespace metamarch
