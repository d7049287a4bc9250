// SPDX-License-Identifier: MIT
// What an integrator returns that runs on a Vulkan device.
#pragma once
#include "metamarch/shared/film_data.h"

#include <cstdint>

namespace metamarch::render {

struct DeviceRender {
    FilmData film;              // camera.width * camera.height pixels
    double deviceSeconds = 0.0; // of all submissions but the first
    double firstSeconds = 0.0;  // of the first submission, in which the driver may compile the kernel
    std::uint32_t submissions = 0;
};

} // namespace metamarch::render
