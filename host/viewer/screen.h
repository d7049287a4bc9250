// SPDX-License-Identifier: MIT
// The pixels of the window's picture.
#pragma once
#include "metamarch/vulkan/buffer.h"

#include <glm/glm.hpp>

namespace metamarch::viewer {

// The pixels of the window's picture, in rows from the top. They stay from frame to frame.
struct Screen {
    glm::uvec2 size; // pixels
    const vulkan::Buffer& pixels;
    bool isBlueFirst; // order in memory: blue, green, red, alpha; otherwise red, green, blue, alpha
    bool isEmpty;     // nothing has been written to the pixels yet
    // The pixels that the window had before its size changed, with the same order in memory; null if it had
    // none.
    const vulkan::Buffer* pixelsBefore;
    glm::uvec2 sizeBefore;
};

} // namespace metamarch::viewer
