// The device computes the shared shading functions to the bit as the CPU does.
#include "kernel_run.h"
#include "kernels/bsdf.h"
#include "random_bsdf_case.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstring>

namespace metamarch::vulkan {
namespace {

TEST(ShadingOnDevice, bsdfHasTheBitsOfTheCpu) {
    const std::vector<BsdfCase> cases = randomBsdfCases(1 << 16);
    KernelTimes times;
    for (uint32_t f : {0u, 1u, 2u, 4u, 12u, 16u, 32u, 63u}) {
        const auto t0 = std::chrono::steady_clock::now();
        runKernel<BsdfAnswer>(bsdfSpirv, "bsdf", cases, {{0, f}}, &times);
        printf("features %u: wall %.3f first %.3f again %.1f ns per\n", f,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count(), times.first,
               times.again * 1e9 / 65536.0);
    }
    const std::vector<BsdfAnswer> answers = runKernel<BsdfAnswer>(bsdfSpirv, "bsdf", cases);
    int wrong = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const BsdfAnswer a = answer(cases[i]);
        if (std::memcmp(&a, &answers[i], sizeof a) != 0 && wrong++ < 5) {
            printf("%zu: %.9g %.9g | %.9g %.9g | pdf %.9g %.9g | w %.9g %.9g wi %.9g %.9g flags %u %u al "
                   "%.9g %.9g\n",
                   i, a.value.x, answers[i].value.x, a.value.y, answers[i].value.y, a.pdf, answers[i].pdf,
                   a.sampleWeight.x, answers[i].sampleWeight.x, a.sampleWi.x, answers[i].sampleWi.x,
                   a.sampleFlags, answers[i].sampleFlags, a.albedo.x, answers[i].albedo.x);
        }
    }
    EXPECT_EQ(wrong, 0);
}

} // namespace
} // namespace metamarch::vulkan
