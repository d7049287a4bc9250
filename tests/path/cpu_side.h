// SPDX-License-Identifier: MIT
// Renders a scene on the CPU, by the judge and by the kernels of the processor.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/processor/processor_kernels.h"
#include "metamarch/render/path_sampler.h"
#include "path/path_scene.h"

#include <cstdint>
#include <vector>

namespace metamarch::tests {

struct Picture {
    std::uint32_t width;
    std::uint32_t height;
};

class CpuSide {
  public:
    CpuSide(const PathScene& given, Picture size);

    FilmData filmByJudge(const PathWork& work) const; // by the judge
    std::vector<FilmPixel> onCpu(const PathWork& work) const { return filmByJudge(work).pixels; }

    // Returns the kernels that can draw the scene.
    std::vector<ProcessorKernel> kernels() const;
    FilmData filmOnCpu(const PathWork& work, Kernel kernel) const;

  protected:
    render::PathWork ofSampler(const PathWork& work) const; // groups of first hits are materials

    PathScene made;
    AccelerationStructure structure;
    ShadingScene shading;
    Camera camera;
};

// Compares all bits except steps and tests, which depend on the traversal.
bool isSamePixel(const FilmPixel& a, const FilmPixel& b);

} // namespace metamarch::tests
