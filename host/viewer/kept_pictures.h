// SPDX-License-Identifier: MIT
// The pictures of KeptViews, as the window showed them, without panels and lines. To show one takes no
// tracing.
#pragma once
#include "metamarch/viewer/kept_views.h"
#include "metamarch/viewer/stretched_picture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace metamarch::viewer {

class KeptPictures {
  public:
    explicit KeptPictures(const vulkan::Device& usedDevice) : device_(usedDevice), stretched_(usedDevice) {}

    // The next paint() keeps the picture of a window of `size` pixels as A or B. Throws Error(outOfMemory).
    void keep(Shown slot, glm::uvec2 size);

    // The next paint() has a screen of `size`, which may be another one than keep() was told. Call it before
    // that paint(). Throws Error(outOfMemory).
    void follow(glm::uvec2 size);

    // Call it once per frame, after the present picture has been painted: lays the one that is shown over
    // it, and then keeps what the screen has, if that is wanted.
    void paint(vulkan::Commands& commands, const Screen& screen, Shown shown);

    // Forgets A and B. No frame may be drawn meanwhile.
    void forget() { kept_ = {}; }

    // Returns true if the picture of A or B is there: one frame after keep().
    bool has(Shown slot) const { return kept_[indexOf(slot)].picture.pixels.has_value(); }

    // Returns the pixels of A or B, which has() has, as those of Presenter::Frame.
    struct Picture {
        std::vector<std::uint32_t> pixels;
        glm::uvec2 size;
    };
    Picture picture(Shown slot) const;

  private:
    struct OnDevice {
        std::optional<vulkan::Buffer> pixels; // in the screen's order of channels
        glm::uvec2 size{0};
        bool isBlueFirst = false;
    };
    struct Kept {
        OnDevice picture;
        OnDevice next; // is to replace it
        OnDevice old;  // was replaced in the frame that may still be drawn
    };
    const vulkan::Device& device_;
    StretchedPicture stretched_;
    std::array<Kept, kKeptSlots.size()> kept_;
};

} // namespace metamarch::viewer
