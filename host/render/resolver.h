// From films to the bytes of a screen, on the device: the kernels `resolve` and `present`.
#pragma once
#include "image/tone_mapping.h"
#include "render/path_tracer.h"
#include "shared/screen.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace metamarch::render {

// A picture of packed pixels (shared/screen.h) in rows, and the film it is made of.
class Resolver {
  public:
    // `mostPixels`: room for pictures of that many. `film` must outlive it and be bound to nothing larger.
    Resolver(const vulkan::Device& device, const vulkan::Buffer& film, std::uint32_t mostPixels);

    // Nothing is there to show any more; of a picture of size.x * size.y pixels.
    void clear(vulkan::Commands& commands, glm::uvec2 size);

    // The tiles of the film that have changed. The film starts with tile 0.
    void resolve(vulkan::Commands& commands, TileRange tiles, const ToneMapping& toneMapping) const;

    const vulkan::Buffer& picture() const { return pictureBuffer; }
    glm::uvec2 size() const { return pictureSize; }

  private:
    vulkan::Buffer pictureBuffer;
    vulkan::ComputePipeline pipeline;
    glm::uvec2 pictureSize{0};
};

} // namespace metamarch::render
