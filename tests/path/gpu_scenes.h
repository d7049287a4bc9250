// SPDX-License-Identifier: MIT
// The scenes on which the path tracers of device and CPU are compared. There is one for each feature, so that
// each specialization of the kernel is tested alone, and one with all features.
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

// GoogleTest prints parameters with this function.
// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
inline void PrintTo(const GpuPathScene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<GpuPathScene>& gpuPathScenes();

// Returns a scene with textures, holes and punctual lights.
PathScene blended();

// Returns a scene with all features.
PathScene everything();

} // namespace metamarch::tests
