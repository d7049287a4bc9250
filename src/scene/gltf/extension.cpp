// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/extension.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace metamarch {
namespace {

constexpr auto kExtensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    // These describe the file or what a user may do with it, not what is seen.
    "EXT_mesh_manifold",
    "GODOT_single_root",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_xmp",
    "KHR_xmp_json_ld",
#ifdef METAMARCH_MESHOPT
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
#endif
#ifdef METAMARCH_WEBP
    "EXT_texture_webp",
#endif
});

// src/scene/README.md says why.
constexpr auto kUndecodedImages = std::to_array<const char*>({
    "EXT_texture_astc",
    "EXT_texture_avif",
    "KHR_texture_basisu",
    "MSFT_texture_dds",
});

} // namespace

bool isSupportedExtension(const std::string& name) {
    return std::ranges::find(kExtensions, name) != kExtensions.end() ||
           std::ranges::find(kUndecodedImages, name) != kUndecodedImages.end();
}

std::span<const char* const> undecodedImageExtensions() { return kUndecodedImages; }

} // namespace metamarch
