// SPDX-License-Identifier: MIT
// The path tracer's picture without its noise, made beside the rendering in a thread of its own.
#pragma once
#include "metamarch/image/denoiser.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/shared/film_data.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <future>
#include <vector>

namespace metamarch::viewer {

class DenoisedPicture {
  public:
    // Forgets the picture: another one begins.
    void clear();

    // Returns true if a film of `samples` a pixel is worth filtering: the samples have doubled since the last
    // one, or are the last, and no film is being filtered.
    bool wants(double samples, bool isLast) const;

    // Begins to filter a film of size.x * size.y pixels. `denoiser` must outlive this object.
    void begin(const Denoiser& denoiser, FilmData film, glm::uvec2 size, double samples);
    bool isWorking() const { return work.valid(); }

    // Takes the result, if there is one. Returns true if it is new. Throws what Denoiser throws.
    bool take();
    bool isEmpty() const { return done.empty(); }

    // Returns packed pixels (shared/packed_pixel.h) in rows from the top.
    std::vector<std::uint32_t> pixels(const ToneMapping& tone) const;

  private:
    struct Pixel {
        glm::vec3 radiance;
        float coverage;
    };
    static std::vector<Pixel> denoise(const Denoiser& denoiser, FilmData film, glm::uvec2 size);

    std::future<std::vector<Pixel>> work;
    bool isOfOtherPicture = false; // what the thread works at
    std::vector<Pixel> done;
    double samplesBegun = 0.0; // of the film that was begun last
};

} // namespace metamarch::viewer
