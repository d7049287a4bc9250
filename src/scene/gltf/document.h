// SPDX-License-Identifier: MIT
// Reads an untrusted .gltf or .glb into a model that is safe to traverse.
#pragma once
#include "metamarch/file/input_file.h"

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace metamarch {

// tinygltf holds accessors, buffer views, meshes, nodes and cameras; the bytes of its buffers are filled in
// by readBuffers. `json` holds what tinygltf would read without checks or not at all: buffers, materials,
// textures, samplers, images, skins, animations and every extension. GltfElement reads it.
struct GltfDocument {
    tinygltf::Model model;
    nlohmann::json json;
};

// tinygltf trusts its input: it recurses as deep as the JSON does, truncates integers to 32 bits, uses
// defaults where a type is wrong, and opens whatever a URI names. So this function checks the JSON first and
// removes what tinygltf need not see, among it every URI. Throws Error(inputRefused). It does not check
// indices between elements; their readers do.
GltfDocument readGltf(InputFile& file);

} // namespace metamarch
