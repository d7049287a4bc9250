// SPDX-License-Identifier: MIT
// Converts materials of OBJ's material libraries, as Assimp reads them, to glTF's materials.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <assimp/material.h>

#include <vector>

namespace metamarch {

// Collects the textures of an OBJ's materials: one for each way in which a file is used.
class MtlTextures {
  public:
    explicit MtlTextures(InputFile& file) : file_(file) {}

    // Converts a material to glTF's terms:
    //   Kd, map_Kd        base colour of a dielectric
    //   d, map_d          alpha of the base colour; if given, the material blends
    //   Ks, map_Ks        scale the 4 % that a dielectric reflects; black reflects nothing
    //   Ns                roughness: GGX's alpha is sqrt(2 / (Ns + 2)) (B. Walter, S. Marschner, H. Li,
    //                     K. Torrance, "Microfacet Models for Refraction through Rough Surfaces", 2007)
    //   Ke, map_Ke        emission; map_Ke alone has factor 1
    //   Pr, Pm, map_Pr, map_Pm   roughness and metallic; they override Ks and Ns
    //   norm              normal map
    //   illum 4, 6, 7, 9  glass: 1 - d is transmitted, with the index of refraction Ni; 6 and 7 refract
    // Numbers outside their range are clamped. Bump, displacement and reflection maps cause a warning.
    Material read(const aiMaterial& source);

    const std::vector<Texture>& textures() const { return textures_; }
    const std::vector<TextureSource>& sources() const { return sources_; }

  private:
    void readTextures(const aiMaterial& source, Material& material);
    TextureRef add(const aiMaterial& source, aiTextureType type, bool isSrgb,
                   std::vector<TextureOverlay> overlays = {});
    TextureRef addWhite(std::vector<TextureOverlay> overlays);
    TextureRef append(const Texture& sampler, TextureSource source, bool isSrgb);

    InputFile& file_;
    std::vector<Texture> textures_;
    std::vector<TextureSource> sources_;
};

} // namespace metamarch
