// SPDX-License-Identifier: MIT
// The paper's experiment (section 4) on its own models: visits per ray and render time of the stack traversal
// and of the march, by view.
#pragma once
#include "metamarch/bench/bench_scene.h"
#include "metamarch/bench/measurement.h"
#include "metamarch/vulkan/device.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace metamarch::bench {

// A model of the paper, with the source of its figures.
struct PaperModel {
    const char* name;
    std::vector<const char*> files; // file names to look for; the first one found is used
    // Length to which the longest side of the model's box is scaled; 0: the file's own size.
    double longestSide;
    double unit;         // unit length of the lattice
    std::uint32_t cells; // number of cells in the paper's table
};

const std::array<PaperModel, 2>& paperModels();

// Finds the model's file in `folder` or in its subfolder `paper`, scales it and builds tree (depth 16) and
// table. Throws Error(inputRefused) if the file is missing or the number of cells differs from the paper's.
std::unique_ptr<BenchScene> loadPaperModel(const PaperModel& model, const std::filesystem::path& folder);

inline constexpr std::array<const char*, 2> kPaperTraversals{"kd_stack", "meta_table"};

// Measures every view with primary rays and with shadow, mirror and diffuse rays from their hits, each for
// kFloor and kPaperTraversals, on the CPU in one thread and on the device. Calls `onRow` for each row.
void benchPaperModel(BenchScene& scene, const vulkan::Device& device, std::uint32_t width,
                     std::uint32_t height, const Protocol& protocol,
                     const std::function<void(const Row&)>& onRow);

// Returns lines of text that compare `rows` with the paper's two claims and define a visit.
std::string compareWithClaims(std::span<const Row> rows);

} // namespace metamarch::bench
