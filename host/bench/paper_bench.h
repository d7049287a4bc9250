// The paper's experiment (section 4) on its own models: visits per ray and render time of the stack traversal
// and the march, by view.
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

// A model of the paper and where its figures come from.
struct PaperModel {
    const char* name;
    std::vector<const char*> files; // names to look for, the first found is taken
    double longestSide;             // of its box, to which the file is scaled; 0: the file's own size
    double unit;                    // unit length of the lattice
    std::uint32_t cells;            // of the paper's table
};

const std::array<PaperModel, 2>& paperModels();

// Finds the model's file in `folder` or its folder `paper`, scales it and builds tree (depth 16) and table.
// Throws Error(inputRefused) where it is missing, or where the lattice has not the paper's cells.
std::unique_ptr<BenchScene> loadPaperModel(const PaperModel& model, const std::filesystem::path& folder);

inline constexpr std::array<const char*, 2> kPaperTraversals{"kd_stack", "meta_table"};

// Every view with primary rays and with the shadow, mirror and diffuse rays from their hits; each for kFloor
// and kPaperTraversals, on the CPU in one thread and on the device. `onRow` is told of each row.
void benchPaperModel(BenchScene& scene, const vulkan::Device& device, std::uint32_t width,
                     std::uint32_t height, const Protocol& protocol,
                     const std::function<void(const Row&)>& onRow);

// The paper's two claims beside what `rows` say, and what a visit is; lines of text.
std::string compareWithClaims(std::span<const Row> rows);

} // namespace metamarch::bench
