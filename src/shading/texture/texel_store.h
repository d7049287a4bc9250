// SPDX-License-Identifier: MIT
// Stores the texels of a scene's images in the words that shaders read, split into chunks.
#pragma once
#include "metamarch/scene/scene.h"
#include "metamarch/shading/texture/mip_levels.h"
#include "metamarch/shared/shading_scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace metamarch {

struct TexelPlace {
    std::uint32_t chunk;
    std::uint32_t firstWord;
};

class TexelStore {
  public:
    // `chunkBytes` is the largest size of a chunk.
    TexelStore(const Scene& scene, std::uint64_t chunkBytes, ShadingScene& target);

    // Returns the record of this texture reference, or kNoTextureRecord if there is no texture. The record
    // has only level 0 until addLevels is called. Throws Error(outOfMemory) if the texels do not fit.
    std::uint32_t add(const TextureRef& ref, ColorWeight weight = ColorWeight::equal);

    // Adds the mip levels of the records, where their filters use them and while they fit. No scene is
    // refused because of them: without mip levels, the averaging is left to samples.
    void addLevels();

    // Returns the mean of each channel of a texture in linear light; 1 if there is no texture.
    glm::vec4 meanOf(const TextureRef& ref) const;

  private:
    using Pyramid = std::tuple<std::uint32_t, bool, ColorWeight>; // image, isSrgb, weight

    std::optional<TexelPlace> place(const std::vector<std::uint32_t>& words);
    TexelPlace placeOf(std::uint32_t image);
    std::vector<TextureLevel> placeLevels(const Pyramid& pyramid);

    const Scene& scene;
    std::uint64_t chunkWords;
    std::uint64_t wordsToCome = 0; // about so many words are not placed yet
    ShadingScene& target;
    std::map<std::uint32_t, TexelPlace> places; // indexed by image
    std::map<Pyramid, std::vector<TextureLevel>> pyramids;
    std::vector<std::pair<std::uint32_t, Pyramid>> wanted; // record and its pyramid
};

} // namespace metamarch
