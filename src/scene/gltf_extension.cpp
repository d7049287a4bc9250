#include "scene/gltf_extension.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace metamarch {
namespace {

constexpr std::array<std::string_view, 2> kGeometryExtensions = {"EXT_mesh_gpu_instancing",
                                                                 "KHR_mesh_quantization"};

constexpr std::array<std::string_view, 9> kLookPrefixes = {
    "ADOBE_materials_", "EXT_lights_", "EXT_texture_",  "KHR_lights_",   "KHR_materials_",
    "KHR_texture_",     "KHR_xmp",     "MSFT_texture_", "EXT_materials_"};

} // namespace

bool isSupportedExtension(const std::string& name) {
    return std::find(kGeometryExtensions.begin(), kGeometryExtensions.end(), name) !=
               kGeometryExtensions.end() ||
           std::any_of(kLookPrefixes.begin(), kLookPrefixes.end(),
                       [&name](std::string_view prefix) { return name.starts_with(prefix); });
}

} // namespace metamarch
