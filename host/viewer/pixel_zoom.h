// SPDX-License-Identifier: MIT
// Which part of the picture the window shows when the user zooms into its pixels. The camera stays.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>

namespace metamarch::viewer {

class PixelZoom {
  public:
    static constexpr std::uint32_t kMost = 64;

    bool isOn() const { return scale_ > 1; }
    std::uint32_t scale() const { return scale_; }  // pixels of the window for one of the picture
    glm::uvec2 skipped() const { return skipped_; } // pixels of the window left of and above what it shows

    // Both places are in pixels from the upper left corner.
    glm::vec2 toPicture(const glm::vec2 window) const {
        return (window + glm::vec2(skipped_)) / static_cast<float>(scale_);
    }
    glm::vec2 toWindow(const glm::vec2 picture) const {
        return picture * static_cast<float>(scale_) - glm::vec2(skipped_);
    }

    // Doubles the scale `times` times, or halves it if that is negative. What lies at `place` of the window
    // stays there, as far as the picture reaches. `size` is that of the window.
    void zoom(int times, glm::vec2 place, glm::uvec2 size);
    // Zooms once for each whole click of the wheel. A touchpad sends parts of clicks, which add up.
    void scroll(float clicks, glm::vec2 place, glm::uvec2 size);
    // Moves the picture by so many pixels of the window.
    void move(glm::vec2 by, glm::uvec2 size);
    // The window has this size now.
    void follow(const glm::uvec2 size) { move(glm::vec2(0.0f), size); }
    void end() { *this = {}; }

  private:
    std::uint32_t scale_ = 1;
    glm::uvec2 skipped_{0};
    float clicks_ = 0.0f; // of the wheel, less than a whole one
};

} // namespace metamarch::viewer
