// SPDX-License-Identifier: MIT
// The scenes on which the device's path tracer is compared with the CPU's: one for each feature, so that each
// specialization of the kernel is seen alone, and all of them together.
#pragma once
#include "path/path_scene.h"

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace metamarch::tests {

struct GpuPathScene {
    std::string name;
    std::function<PathScene()> make;
    PathWork work{.samples = 5, .maxBounces = 6};
};

// How GoogleTest names one.
inline void PrintTo(const GpuPathScene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<GpuPathScene>& gpuPathScenes();

// Textures, holes, punctual lights.
PathScene blended();

// Of every feature there is.
PathScene everything();

} // namespace metamarch::tests
