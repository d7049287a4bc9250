// The texels of a scene's images in the words that shaders read, cut into chunks.
#pragma once
#include "scene/scene.h"
#include "scene/shading_scene.h"

#include <cstdint>
#include <map>
#include <vector>

namespace metamarch {

class TexelStore {
  public:
    // `chunkBytes`: the most that a chunk holds.
    TexelStore(const Scene& scene, std::uint64_t chunkBytes, ShadingScene& target);

    // The record of this use, kNoTextureRecord for none. Throws Error(outOfMemory) where the texels do not
    // fit.
    std::uint32_t add(const TextureRef& ref);

    // Means of the channels of a texture in linear light, 1 for none.
    glm::vec4 meanOf(const TextureRef& ref) const;

  private:
    struct Place {
        std::uint32_t chunk;
        std::uint32_t firstWord;
    };

    Place placeOf(std::uint32_t image);

    const Scene& scene;
    std::uint64_t chunkWords;
    ShadingScene& target;
    std::map<std::uint32_t, Place> places; // [image]
};

} // namespace metamarch
