// SPDX-License-Identifier: MIT
// Google Benchmark of building tree and table.
//
//   metamarch_build_bench [options of Google Benchmark] [SCENE...]
//
// Without a scene it builds over a sphere with 200,000 triangles. Importing the file is not measured.
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/error/error.h"
#include "metamarch/scene/import.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>

namespace {

using namespace metamarch;

constexpr std::uint32_t kSlices = 500;
constexpr std::uint32_t kStacks = 201; // gives 2 * kSlices * (kStacks - 1) triangles

Scene sphere() {
    Scene scene;
    for (std::uint32_t stack = 0; stack <= kStacks; ++stack) {
        const double polar = std::numbers::pi * stack / kStacks;
        for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
            const double azimuth = 2.0 * std::numbers::pi * slice / kSlices;
            scene.positions.emplace_back(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                         std::sin(polar) * std::sin(azimuth));
        }
    }
    const auto vertex = [](const std::uint32_t stack, const std::uint32_t slice) {
        return stack * kSlices + slice % kSlices;
    };
    for (std::uint32_t stack = 0; stack < kStacks; ++stack) {
        for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
            if (stack != 0) {
                scene.triangles.emplace_back(vertex(stack, slice), vertex(stack, slice + 1),
                                             vertex(stack + 1, slice));
            }
            if (stack + 1 != kStacks) {
                scene.triangles.emplace_back(vertex(stack, slice + 1), vertex(stack + 1, slice + 1),
                                             vertex(stack + 1, slice));
            }
        }
    }
    return scene;
}

void build(benchmark::State& state, const Scene& scene) {
    for ([[maybe_unused]] const auto _ : state) {
        benchmark::DoNotOptimize(buildAccelerationStructure(scene, {}));
    }
    state.counters["triangles"] = static_cast<double>(scene.triangles.size());
    state.counters["triangles/s"] = benchmark::Counter(static_cast<double>(scene.triangles.size()),
                                                       benchmark::Counter::kIsIterationInvariantRate);
}

void add(const std::string& name, Scene scene) {
    const auto shared = std::make_shared<Scene>(std::move(scene));
    benchmark::RegisterBenchmark(("build/" + name).c_str(),
                                 [shared](benchmark::State& state) { build(state, *shared); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime(); // the build is parallel
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    try {
        for (int i = 1; i < argc; ++i) {
            if (argv[i][0] == '-') {
                benchmark::ReportUnrecognizedArguments(argc, argv);
                return static_cast<int>(ErrorKind::invalidArgument);
            }
            add(std::filesystem::path(argv[i]).filename().string(), loadScene(argv[i]));
        }
        if (argc == 1) {
            add("sphere", sphere());
        }
        benchmark::RunSpecifiedBenchmarks();
    } catch (const Error& error) {
        std::fprintf(stderr, "metamarch_build_bench: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
