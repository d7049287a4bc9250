// SPDX-License-Identifier: MIT
// Renders a scene on the device and on the CPU, and compares the films.
#pragma once
#include "metamarch/render/path_sampler.h"
#include "path/cpu_side.h"

#include <string>
#include <vector>

namespace metamarch::tests {

class BothSides : public CpuSide {
  public:
    using CpuSide::CpuSide;

    enum class Where { fasterMemory, storageBuffers };

    struct DeviceRender {
        FilmData film;
        std::uint32_t submissions;
    };

    DeviceRender onDevice(const std::string& traversal, const PathWork& work,
                          Where where = Where::fasterMemory,
                          std::uint32_t mostTiles = render::DevicePathSampler::kMostTiles) const;
};

extern const std::string kDefaultTraversal;

// Returns true if two films of the same samples show the same picture: their mean radiances differ by at most
// four standard errors and a part in a thousand, and at most one pixel in twenty by more than a hundredth.
bool isSamePicture(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b);

// Expect the same bits on a device that keeps bits, and the same picture on others.
void expectSameFilm(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& expected);

void expectSameLight(const std::vector<LightParts>& light, const std::vector<LightParts>& expected);

// Expects a film whose pixels are neither all black nor all equal.
void expectPicture(const std::vector<FilmPixel>& film);

} // namespace metamarch::tests
