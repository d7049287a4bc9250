// SPDX-License-Identifier: MIT
#include "metamarch/viewer/pixel_zoom.h"

#include <cmath>

namespace metamarch::viewer {

void PixelZoom::zoom(const int times, const glm::vec2 place, const glm::uvec2 size) {
    const glm::vec2 fixed = toPicture(place);
    for (int i = 0; i < times && scale_ < kMost; ++i) {
        scale_ *= 2;
    }
    for (int i = 0; i > times && scale_ > 1; --i) {
        scale_ /= 2;
    }
    skipped_ = glm::uvec2(0);
    move(place - toWindow(fixed), size);
}

void PixelZoom::scroll(const float clicks, const glm::vec2 place, const glm::uvec2 size) {
    clicks_ += clicks;
    const float whole = std::trunc(clicks_);
    clicks_ -= whole;
    zoom(static_cast<int>(whole), place, size);
}

void PixelZoom::move(const glm::vec2 by, const glm::uvec2 size) {
    const glm::vec2 most = glm::vec2(size) * static_cast<float>(scale_ - 1);
    skipped_ = glm::uvec2(glm::round(glm::clamp(glm::vec2(skipped_) - by, glm::vec2(0.0f), most)));
}

} // namespace metamarch::viewer
