// SPDX-License-Identifier: MIT
// Renders a scene on the device and on the CPU, and compares the films.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/render/path_sampler.h"
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

    FilmData filmOnCpu(const PathWork& work) const;
    std::vector<FilmPixel> onCpu(const PathWork& work) const { return filmOnCpu(work).pixels; }

    enum class Where { fasterMemory, storageBuffers };

    struct DeviceRender {
        FilmData film;
        std::uint32_t submissions;
    };

    DeviceRender onDevice(const std::string& traversal, const PathWork& work,
                          Where where = Where::fasterMemory,
                          std::uint32_t mostTiles = render::DevicePathSampler::kMostTiles) const;

  private:
    PathSettings settings(const PathWork& work) const;
    FilmRequest request(const PathWork& work) const; // groups are materials

    PathScene made;
    AccelerationStructure structure;
    ShadingScene shading;
    ShadingData primary;
    Camera camera;
};

extern const std::string kDefaultTraversal;

// Compares all bits except steps and tests, which depend on the traversal.
bool isSamePixel(const FilmPixel& a, const FilmPixel& b);

// Returns true if two films of the same samples show the same picture: their mean radiances differ by at most
// four standard errors and a part in a thousand, and at most one pixel in twenty by more than a hundredth.
bool isSamePicture(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b);

// Expect the same bits on a device that keeps bits, and the same picture on others.
void expectSameFilm(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& expected);

void expectSameLight(const std::vector<LightParts>& light, const std::vector<LightParts>& expected);

// Expects a film whose pixels are neither all black nor all equal.
void expectPicture(const std::vector<FilmPixel>& film);

} // namespace metamarch::tests
