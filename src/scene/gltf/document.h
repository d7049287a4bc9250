// From an untrusted .gltf or .glb to a model that is safe to walk.
#pragma once
#include "metamarch/file/input_file.h"

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

namespace metamarch {

// tinygltf holds buffers, accessors, meshes, nodes and cameras; `json` all that it would read without checks
// or not at all: materials, textures, samplers, images, skins, animations and every extension, for
// GltfElement.
struct GltfDocument {
    tinygltf::Model model;
    nlohmann::json json;
};

// tinygltf trusts what it parses: it recurses as deep as the JSON does, cuts integers to 32 bits, falls back
// to defaults where a type is wrong, and opens whatever a URI names. So the JSON is checked first, and
// stripped of what tinygltf need not see, which then cannot do harm either. Throws Error(inputRefused).
// Indices between elements are not checked here, their readers do that.
GltfDocument readGltf(InputFile& file);

} // namespace metamarch
