// SPDX-License-Identifier: MIT
#include "metamarch/bench/paper_bench.h"

#include "metamarch/bench/secondary_rays.h"
#include "metamarch/bench/traversal_bench.h"
#include "metamarch/bench/views.h"
#include "metamarch/error/error.h"
#include "metamarch/scene/import.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace metamarch::bench {
namespace {

std::filesystem::path findModel(const PaperModel& model, const std::filesystem::path& folder) {
    for (const std::filesystem::path& place : {folder, folder / "paper"}) {
        for (const char* const file : model.files) {
            if (std::filesystem::is_regular_file(place / file)) {
                return place / file;
            }
        }
    }
    throw Error(ErrorKind::inputRefused,
                fmt::format("{}: the paper's {} is not there ({}); tools/fetch_scenes gets it",
                            folder.string(), model.name, fmt::join(model.files, " or ")),
                {"scenes"});
}

double longestSide(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    return static_cast<double>(largest(bounds.hi - bounds.lo));
}

// Returns the rays of a view: the camera's, and from each of their hits one ray of each kind.
std::vector<JudgedRays> raysOfView(const BenchScene& scene, const AxisView& view, const std::uint32_t width,
                                   const std::uint32_t height) {
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const std::vector<RayQuery> primary =
        cameraRays(makeCamera(fillingCamera(scene.scene, view, aspect), width, height));
    const std::vector<SurfacePoint> points = surfacePoints(scene.structure, primary);
    const Lattice& lattice = scene.structure.lattice;
    std::vector<JudgedRays> sets;
    const auto add = [&](const char* const name, RaySet set) {
        sets.push_back(judgeRays(scene, name, view.name, std::move(set)));
    };
    add("primary", {primary});
    add("shadow", shadowRays(lattice, points));
    add("mirror", mirrorRays(lattice, points));
    add("diffuse", diffuseRays(lattice, points));
    return sets;
}

} // namespace

// The paper's numbers of cells follow from ceil(extent / unit) cells per axis: for the Viewpoint cow divided
// by 10, whose longest side is 1.04439, and for the bunny in its own size.
const std::array<PaperModel, 2>& paperModels() {
    static const std::array<PaperModel, 2> kModels{
        {{"cow", {"cow.off", "cow_viewpoint.obj"}, 1.04439, 0.02, 30528},
         {"bunny", {"bunny.ply", "bunny.obj"}, 0.0, 0.002, 371124}}};
    return kModels;
}

std::unique_ptr<BenchScene> loadPaperModel(const PaperModel& model, const std::filesystem::path& folder) {
    const std::filesystem::path file = findModel(model, folder);
    Scene scene = loadScene(file);
    if (model.longestSide > 0.0) {
        scene = loadScene(file, {.scale = static_cast<float>(model.longestSide / longestSide(scene))});
    }
    const AccelerationOptions options{
        .unit = glm::dvec3(model.unit), .cells = {}, .treeDepth = kPaperTreeDepth, .exitBoxes = false};
    auto result = std::make_unique<BenchScene>(model.name, std::move(scene), options);
    if (result->structure.lattice.cellCount != model.cells) {
        throw Error(
            ErrorKind::inputRefused,
            fmt::format("{}: {} cells of {} instead of the paper's {}: another model, or another size",
                        file.string(), result->structure.lattice.cellCount, model.unit, model.cells));
    }
    return result;
}

void benchPaperModel(BenchScene& scene, const vulkan::Device& device, const std::uint32_t width,
                     const std::uint32_t height, const Protocol& protocol,
                     const std::function<void(const Row&)>& onRow) {
    const render::SceneBuffers buffers(device, scene.structure, scene.shading);
    for (const AxisView& view : kAxisViews) {
        for (const JudgedRays& rays : raysOfView(scene, view, width, height)) {
            const Row cpuFloor = benchFloorOnCpu(scene, rays, protocol);
            onRow(cpuFloor);
            for (const char* const traversal : kPaperTraversals) {
                Row row = benchOnCpu(scene, rays, traversal, protocol);
                compareWithFloor(row, cpuFloor);
                onRow(row);
            }
            const Row deviceFloor = benchFloorOnDevice(scene, rays, device, buffers, protocol);
            onRow(deviceFloor);
            for (const char* const traversal : kPaperTraversals) {
                Row row = benchOnDevice(scene, rays, traversal, device, buffers, protocol);
                compareWithFloor(row, deviceFloor);
                onRow(row);
            }
        }
    }
}

} // namespace metamarch::bench
