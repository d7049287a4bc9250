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
    std::string file; // below the shared scenes, or "scenes/..." for one of the project's own; "": a sphere
    float scale = 1.0f;
    AccelerationOptions options{};
    bool inStadium = false; // on a plane 10,000 times larger
};

// How GoogleTest names one.
inline void PrintTo(const GpuScene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<GpuScene>& gpuScenes();

// Ends the test where the file is one of the shared scenes and is absent.
Scene load(const GpuScene& scene);

} // namespace metamarch::tests
