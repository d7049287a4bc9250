// SPDX-License-Identifier: MIT
// A glTF file to a picture of floats, by the path tracer on the CPU.
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/path.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/lit_scene.h"
#include "metamarch/shading/view.h"

#include <cstdio>
#include <exception>
#include <vector>

int main(const int argc, char** argv) try {
    if (argc != 2) {
        std::fputs("render SCENE\n", stderr);
        return 2;
    }
    constexpr std::uint32_t kSide = 64;
    constexpr std::uint32_t kSamples = 4;
    const metamarch::Scene scene = metamarch::loadScene(argv[1]);
    const metamarch::PathChoice path;
    const metamarch::LitScene lit = metamarch::lightScene(scene, argv[1], path, {});
    const metamarch::AccelerationStructure structure = metamarch::buildAccelerationStructure(scene, {});
    const metamarch::Camera camera = metamarch::makeCamera(scene.cameras.at(0), kSide, kSide);
    const std::vector<metamarch::FilmPixel> film = metamarch::renderPaths(
        structure, lit.shading, path.applied(lit.shading.settings), camera, kSamples, [](unsigned) {});
    const metamarch::FilmPixel& centre = film[kSide / 2 * kSide + kSide / 2];
    std::printf("red %.4f in the centre\n", static_cast<double>(centre.radiance.x) / kSamples);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
