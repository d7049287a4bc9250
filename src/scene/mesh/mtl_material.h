// Materials of OBJ's material libraries, as Assimp reads them, to glTF's.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <assimp/material.h>

#include <vector>

namespace metamarch {

// The textures of an OBJ's materials, collected: a texture for every way a file is used.
class MtlTextures {
  public:
    explicit MtlTextures(InputFile& file) : file_(file) {}

    // How the material looks in glTF's terms:
    //   Kd, map_Kd        base colour of a dielectric; its alpha is d, map_d, and it blends where they are
    //   given Ks, map_Ks        scale the 4 % that a dielectric reflects; black reflects nothing Ns
    //   roughness: GGX's alpha is sqrt(2 / (Ns + 2)) (B. Walter, S. Marschner, H. Li,
    //                     K. Torrance, "Microfacet Models for Refraction through Rough Surfaces", 2007)
    //   Ke, map_Ke        emission; map_Ke alone is as bright as it is
    //   Pr, Pm, map_Pr, map_Pm   roughness and metallic, which put Ks and Ns aside
    //   norm              normal map
    //   illum 4, 6, 7, 9  glass: 1 - d is transmitted, with the index of refraction Ni; 6 and 7 refract
    // Numbers outside their range are clamped. Bump, displacement and reflection maps get a warning.
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
