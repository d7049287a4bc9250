// SPDX-License-Identifier: MIT
// Removes noise from the picture of a film that has few samples, for the eye alone, with the kernels
// `filter_...` (shared/display_filter.h). The more samples, the less it changes.
#pragma once
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/render/work_size.h"
#include "metamarch/shared/display_filter.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metamarch::render {

class DisplayFilter {
  public:
    // From so many samples on the filter changes nothing.
    static constexpr std::uint32_t kEnough = 32;

    // Returns true if kernels see the filter's buffers for so many pixels.
    static bool fits(const vulkan::Device& device, std::uint64_t pixels);

    // Allocates room for pictures of up to `mostPixels` pixels. `tracer` and `picture`, which has a word for
    // each pixel, must outlive the filter. Throws Error(outOfMemory).
    DisplayFilter(const vulkan::Device& device, const PathTracer& tracer, const vulkan::Buffer& picture,
                  std::uint32_t mostPixels);

    // Takes the tracer's film, in which each pixel has `samples` samples: at least 1, fewer than kEnough. The
    // film covers the picture from place 0 on.
    void start(glm::uvec2 size, std::uint32_t samples);
    // Goes on in one submission of about `seconds`. Returns true once the result is there.
    bool advance(double seconds);
    bool isWorking() const { return stage < stages.size() && size.x > 0; }
    void stop() { size = {}; }

    // Writes the last result into the picture, of which alpha stays, also while another one is on its way.
    void show(vulkan::Commands& commands, const ToneMapping& tone) const;

  private:
    // A kernel that goes over all rows.
    struct Stage {
        vulkan::ComputePipeline pipeline;
        std::uint32_t distance; // FilterPush::distance
    };

    FilterPush push() const;

    const vulkan::Device& device;
    const DeviceFilm& film;
    vulkan::Buffer surfaces;
    vulkan::Buffer shapes;
    vulkan::Buffer before;
    vulkan::Buffer even; // light after the stages in turn
    vulkan::Buffer odd;
    vulkan::Buffer result;                          // the radiance of the picture that is shown
    std::vector<vulkan::ComputePipeline> beginning; // one for each band of the film
    std::vector<Stage> stages;                      // variance, the passes, the result
    vulkan::ComputePipeline showing;
    vulkan::Submission submission;
    WorkSize work; // unit: a row

    glm::uvec2 size{0}; // 0: there is nothing to filter
    std::uint32_t samples = 1;
    std::size_t stage = 0;
    std::uint32_t row = 0; // the next one of the stage
};

} // namespace metamarch::render
