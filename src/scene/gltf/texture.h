// SPDX-License-Identifier: MIT
// glTF textures: images, samplers and the references of materials to them.
#pragma once
#include "metamarch/scene/gltf/document.h"
#include "metamarch/scene/gltf/element.h"
#include "metamarch/scene/texture.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <map>
#include <utility>
#include <vector>

namespace metamarch {

class GltfTextures {
  public:
    // Throws Error(inputRefused) for samplers and images that do not exist and for unknown filters and wrap
    // modes. `document` and `file` must outlive this object and its sources.
    GltfTextures(const GltfDocument& document, InputFile& file);

    // Both are in the file's order, except that the sources of textures without a readable image, and what
    // roughnessRef made, come last.
    const std::vector<Texture>& textures() const { return textures_; }
    const std::vector<TextureSource>& sources() const { return sources_; }

    // Returns the texture that member `key` of `material` refers to, with KHR_texture_transform. `texture` is
    // an index into textures(); `texCoord` is the file's.
    TextureRef ref(const GltfElement& material, const char* key, bool isSrgb) const;

    // Returns the same texture with roughness, 1 - glossiness * alpha, in its green channel.
    TextureRef roughnessRef(const GltfElement& material, const char* key, float glossiness);

  private:
    std::vector<Texture> textures_; // the file's, and after them those that roughnessRef made
    std::size_t texturesOfFile_ = 0;
    std::vector<TextureSource> sources_;
    std::map<std::pair<std::uint32_t, float>, std::uint32_t> roughness_; // texture by texture and glossiness
};

} // namespace metamarch
