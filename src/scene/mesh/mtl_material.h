// SPDX-License-Identifier: MIT
// Converts materials of MTL to glTF's.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/mesh/mtl_reader.h"
#include "metamarch/scene/mesh/name_list.h"
#include "metamarch/scene/texture/texture_loader.h"

#include <initializer_list>
#include <string>
#include <unordered_map>
#include <vector>

namespace metamarch {

// Collects the textures of an OBJ's materials: one for each way in which a file is used.
class MtlTextures {
  public:
    explicit MtlTextures(InputFile& file) : file_(file) {}

    // Converts a material to glTF's terms:
    //   Kd, map_Kd        base colour of a dielectric; without both it is 0.6
    //   d, map_d          alpha of the base colour; if below 1, the material blends
    //   Tr                1 - d; d itself if MeshLab wrote the file, or if otherwise nothing would be seen
    //   Ks, map_Ks        scale the 4 % that a dielectric reflects; black reflects nothing
    //   Ns                roughness: GGX's alpha is sqrt(2 / (Ns + 2)) (B. Walter, S. Marschner, H. Li,
    //                     K. Torrance, "Microfacet Models for Refraction through Rough Surfaces", 2007)
    //   Ke, map_Ke        emission
    //   Pr, Pm, map_Pr, map_Pm   roughness and metallic; they override Ks and Ns
    //   Ps, map_Ps        white sheen of roughness 0.5, as in Blender
    //   Pc, Pcr, map_Pc, map_Pcr   clear coat and its roughness
    //   aniso, anisor     anisotropy and its rotation in turns
    //   norm              normal map; -bm scales it
    //   bump, map_bump    normal map from heights (texture/height_map.h), or the normal map that Blender
    //                     writes as a bump map; -bm scales both
    //   illum 4, 6, 7, 9  glass: 1 - d is transmitted, with the index of refraction Ni; 6 and 7 refract
    // A map without its number has factor 1. Numbers outside their range are clamped.
    Material read(const MtlMaterial& source);

    // Warns of what the materials that were read have and is not rendered.
    void warn();

    const std::vector<Texture>& textures() const { return textures_; }
    const std::vector<TextureSource>& sources() const { return sources_; }

  private:
    void readOpacity(const MtlMaterial& source, Material& material);
    void readColorMaps(const MtlMaterial& source, Material& material);
    void readPhysicalMaps(const MtlMaterial& source, Material& material);
    void readNormalMaps(const MtlMaterial& source, Material& material);
    void noteUnlessSameUse(const MtlMap& map, const MtlMap& shared);
    const EncodedImage& imageOf(const MtlMap& map);
    TextureOverlay overlayOf(const MtlMap& map, int channel);
    TextureSource greySource(const MtlMap& map, std::initializer_list<int> channels);
    TextureRef add(const MtlMap& map, TextureSource source, bool isSrgb);

    InputFile& file_;
    std::vector<Texture> textures_;
    std::vector<TextureSource> sources_;
    std::unordered_map<std::string, std::uint32_t>
        pictures_; // index into sources_ by all that makes a picture
    std::unordered_map<std::string, EncodedImage> imageOfName_; // by folder and name in the library
    NameList madeOpaque_;
    NameList invisible_;
    NameList withoutBumpMap_;
    NameList mapsWithoutOptions_;
};

} // namespace metamarch
