// SPDX-License-Identifier: MIT
// The kernels `rays` and `primary` that the processor executes find what the judges find, bit by bit, for
// each set of instructions.
#include "fixtures/expect_error.h"
#include "fixtures/ray_sets.h"
#include "metamarch/processor/processor_kernels.h"
#include "metamarch/reference/primary.h"
#include "metamarch/reference/twins.h"
#include "metamarch/render/primary_renderer.h"
#include "metamarch/render/processor_input.h"
#include "metamarch/render/ray_tracer.h"
#include "metamarch/shading/view.h"
#include "traversal/gpu_scenes.h"
#include "traversal/judges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace metamarch::tests {
namespace {

class Processor : public testing::TestWithParam<GpuScene> {
  protected:
    const Scene scene = load(GetParam());
    const AccelerationStructure structure = buildAccelerationStructure(scene, GetParam().options);
};

TEST_P(Processor, hitsWhatTheJudgesHit) {
    // The last call of the kernel has few rays, and its last eight lanes are not all at work.
    const std::vector<RayQuery> rays = trickyRays(scene, structure, 20003, 5);
    const StructureSet structures(structure);
    const auto stack = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return traceKdStack(structure, ray, HitQuery::closest);
    });
    const auto march = traceAll(structure.lattice, rays, [&](const Ray& ray) {
        return findTwin("meta_table").checked(structures, ray, HitQuery::closest);
    });
    EXPECT_GT(std::ranges::count_if(stack, [](const RayResult& r) { return r.triangleId != kNoTriangle; }),
              1000)
        << "too few hits for a meaningful test";
    for (const ProcessorKernel& kernel : rayKernels()) {
        SCOPED_TRACE(kernel.name);
        const auto results = render::traceOnCpu(structure, rays, kernel.run);
        expectSameHits(rays, results, stack, Counters::ignored);
        expectSameHits(rays, results, march, Counters::compared);
    }
}

TEST_P(Processor, drawsThePictureTheJudgeDraws) {
    const ShadingData shading = makeShadingData(scene);
    // The last tiles of rows and columns are cut.
    const Camera camera =
        makeCamera(frameBounds(boundsOf(scene), kDefaultVerticalFov, 4.0f / 3.0f), 165, 123);
    const auto expected =
        renderPrimaryByJudge(structure, shading.materials, shading.materialOfTriangle, camera);
    for (const ProcessorKernel& kernel : primaryKernels()) {
        SCOPED_TRACE(kernel.name);
        const auto pixels = render::renderPrimaryOnCpu(structure, shading, camera, {}, kernel.run);
        ASSERT_EQ(pixels.size(), expected.size());
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            // All bits but those of steps and tests, which depend on the traversal.
            ASSERT_EQ(std::memcmp(&pixels[i], &expected[i], offsetof(FilmPixel, steps)), 0) << "pixel " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Processor, testing::ValuesIn(gpuScenes()),
                         [](const auto& instance) { return instance.param.name; });

TEST(TraceOnCpu, takesNoRays) {
    const Scene scene = load({"cornell", "scenes/cornell.glb"});
    EXPECT_TRUE(render::traceOnCpu(buildAccelerationStructure(scene, {}), {}).empty());
}

TEST(EmptyScene, isMissed) {
    const AccelerationStructure structure = buildAccelerationStructure(Scene{}, {});
    const RayQuery ray{{0, 0, 0}, 0.0f, {0, 0, 1}, kFarthest};
    for (const ProcessorKernel& kernel : rayKernels()) {
        const auto results = render::traceOnCpu(structure, std::span(&ray, 1), kernel.run);
        EXPECT_EQ(results.at(0).triangleId, kNoTriangle) << kernel.name;
    }
    const Camera camera = makeCamera(lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0}), 5, 3);
    for (const ProcessorKernel& kernel : primaryKernels()) {
        for (const FilmPixel& pixel :
             render::renderPrimaryOnCpu(structure, makeShadingData(Scene{}), camera, {}, kernel.run)) {
            EXPECT_EQ(pixel.seen.triangleId, kNoTriangle) << kernel.name;
        }
    }
}

TEST(ProcessorInput, refusesWhatLanesCannotCount) {
    KernelInput input{};
    const std::byte byte{};
    const std::span<const std::byte> most(&byte, 0xffffffffu); // never read
    EXPECT_NO_THROW(render::bindBytes(input, 0, most));
    EXPECT_EQ(lineOfError(ErrorKind::outOfMemory,
                          [&] {
                              render::bindBytes(input, 0, {&byte, std::size_t{1} << 32u});
                          }),
              "an array of the scene takes 4.0 GiB, more than the 4 GiB that the cpu's kernels read; "
              "kd_stack or a gpu reads more");
}

TEST(PrimaryOnCpu, keepsEmptyPixelsWhereItIsCancelled) {
    const Scene scene = load({"cornell", "scenes/cornell.glb"});
    const AccelerationStructure structure = buildAccelerationStructure(scene, {});
    const Camera camera = makeCamera(frameBounds(boundsOf(scene), kDefaultVerticalFov, 1.0f), 512, 512);
    const auto pixels =
        render::renderPrimaryOnCpu(structure, makeShadingData(scene), camera, [](double) { return false; });
    const auto drawn =
        std::ranges::count_if(pixels, [](const FilmPixel& pixel) { return pixel.samples == 1; });
    EXPECT_GT(drawn, 0);
    EXPECT_LT(drawn, 512 * 512);
}

} // namespace
} // namespace metamarch::tests
