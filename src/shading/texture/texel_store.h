// The texels of a scene's images in the words that shaders read, cut into chunks.
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
    // `chunkBytes`: the most that a chunk holds.
    TexelStore(const Scene& scene, std::uint64_t chunkBytes, ShadingScene& target);

    // The record of this use, kNoTextureRecord for none; it has the full size only, until addLevels. Throws
    // Error(outOfMemory) where the texels do not fit.
    std::uint32_t add(const TextureRef& ref, ColorWeight weight = ColorWeight::equal);

    // Gives the records that were added their smaller levels, where their filters ask for them and as long as
    // they fit: no scene is refused for them, and without them samples alone do the averaging.
    void addLevels();

    // Means of the channels of a texture in linear light, 1 for none.
    glm::vec4 meanOf(const TextureRef& ref) const;

  private:
    using Pyramid = std::tuple<std::uint32_t, bool, ColorWeight>; // image, isSrgb

    std::optional<TexelPlace> place(const std::vector<std::uint32_t>& words);
    TexelPlace placeOf(std::uint32_t image);
    std::vector<TextureLevel> placeLevels(const Pyramid& pyramid);

    const Scene& scene;
    std::uint64_t chunkWords;
    ShadingScene& target;
    std::map<std::uint32_t, TexelPlace> places; // [image]
    std::map<Pyramid, std::vector<TextureLevel>> pyramids;
    std::vector<std::pair<std::uint32_t, Pyramid>> wanted; // of records
};

} // namespace metamarch
