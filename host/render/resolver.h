// SPDX-License-Identifier: MIT
// Turns films into pictures with 8 bits per channel, on the device, with the kernel `resolve`.
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/shared/screen.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace metamarch::render {

// Owns a picture of packed pixels (shared/screen.h), in rows from the top, and refers to the film of a path
// tracer.
class Resolver {
  public:
    // Allocates room for pictures of up to `mostPixels` pixels. `tracer` must outlive the resolver.
    Resolver(const vulkan::Device& device, const PathTracer& tracer, std::uint32_t mostPixels);

    // Resolves `tiles` of a picture of size.x * size.y pixels. The film must start at place 0.
    void resolve(vulkan::Commands& commands, TileRange tiles, glm::uvec2 size,
                 const ToneMapping& toneMapping) const;

    const vulkan::Buffer& picture() const { return pictureBuffer; }

  private:
    vulkan::Buffer pictureBuffer;
    const DeviceFilm& film;
    std::vector<vulkan::ComputePipeline> pipelines; // one for each band of the film
};

} // namespace metamarch::render
