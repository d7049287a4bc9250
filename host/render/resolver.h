// SPDX-License-Identifier: MIT
// From films to pictures of 8 bits, on the device: the kernel `resolve`.
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/shared/screen.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace metamarch::render {

// A picture of packed pixels (shared/screen.h) in rows, and the film it is made of.
class Resolver {
  public:
    // `mostPixels`: room for pictures of that many. `film` must outlive it.
    Resolver(const vulkan::Device& device, const vulkan::Buffer& film, std::uint32_t mostPixels);

    // Some tiles of the film, which starts with tile 0, of a picture of size.x * size.y pixels.
    void resolve(vulkan::Commands& commands, TileRange tiles, glm::uvec2 size,
                 const ToneMapping& toneMapping) const;

    const vulkan::Buffer& picture() const { return pictureBuffer; }

  private:
    vulkan::Buffer pictureBuffer;
    vulkan::ComputePipeline pipeline;
};

} // namespace metamarch::render
