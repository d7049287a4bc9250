// SPDX-License-Identifier: MIT
// A scene on the device and on the CPU, and whether both draw the same film.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/render/path_renderer.h"
#include "metamarch/shading/shading.h"
#include "path/path_scene.h"

#include <string>
#include <vector>

namespace metamarch::tests {

struct Picture {
    std::uint32_t width;
    std::uint32_t height;
};

class BothSides {
  public:
    BothSides(const PathScene& given, Picture size);

    std::vector<FilmPixel> onCpu(const PathWork& work) const;

    enum class Where { fasterMemory, storageBuffers };

    render::PathRender onDevice(const std::string& traversal, const PathWork& work,
                                Where where = Where::fasterMemory) const;

  private:
    PathScene made;
    AccelerationStructure structure;
    ShadingScene shading;
    ShadingData primary;
    Camera camera;
};

extern const std::string kDefaultTraversal;

// To the bit, but for steps and tests, which belong to the traversal.
bool isSamePixel(const FilmPixel& a, const FilmPixel& b);
void expectSameFilm(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& expected);

// Not all of them black or alike.
void expectPicture(const std::vector<FilmPixel>& film);

} // namespace metamarch::tests
