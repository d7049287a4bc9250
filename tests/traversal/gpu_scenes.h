// SPDX-License-Identifier: MIT
// The scenes on which the device is compared with the judges.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/scene/scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace metamarch::tests {

struct GpuScene {
    std::string name;
    std::string file; // in the folder of shared scenes; "scenes/...": one of the project's; "": a sphere
    float scale = 1.0f;
    AccelerationOptions options{};
    bool inStadium = false; // adds a plane that is 10,000 times larger
};

// GoogleTest prints parameters with this function.
// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
inline void PrintTo(const GpuScene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<GpuScene>& gpuScenes();

// Ends the test if the file is a shared scene that does not exist: see sharedScene.
Scene load(const GpuScene& scene);

} // namespace metamarch::tests
