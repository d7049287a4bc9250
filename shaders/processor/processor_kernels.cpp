// SPDX-License-Identifier: MIT
#include "metamarch/processor/processor_kernels.h"

#include "metamarch/shared/features.h"

namespace metamarch {

void path_baseline(const KernelInput& input);
#ifdef __x86_64__
void path_avx2(const KernelInput& input);
void path_avx512(const KernelInput& input);
void plain_path_avx2(const KernelInput& input);
void plain_path_avx512(const KernelInput& input);
#else
void plain_path_baseline(const KernelInput& input);
#endif

namespace {

constexpr std::uint32_t kRareFeatures =
    kBsdfFeatures | kFeatureAnisotropy | kFeatureDispersion | kFeatureCatcher | kFeatureThinGlass;
static_assert(kRareFeatures == METAMARCH_RARE_FEATURES, "RARE_FEATURES in CMakeLists.txt");

} // namespace

std::vector<ProcessorKernel> pathKernels(const std::uint32_t features) {
    const bool isPlain = (features & kRareFeatures) == 0;
    std::vector<ProcessorKernel> kernels;
    const auto add = [&](const bool isExecutable, const ProcessorKernel& plain,
                         const ProcessorKernel& whole) {
        if (isExecutable && isPlain) {
            kernels.push_back(plain);
        }
        if (isExecutable) {
            kernels.push_back(whole);
        }
    };
#ifdef __x86_64__
    add(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"),
        {"plain_path_avx512", plain_path_avx512}, {"path_avx512", path_avx512});
    add(__builtin_cpu_supports("avx2"), {"plain_path_avx2", plain_path_avx2}, {"path_avx2", path_avx2});
    kernels.push_back({"path_baseline", path_baseline});
#else
    add(true, {"plain_path_baseline", plain_path_baseline}, {"path_baseline", path_baseline});
#endif
    return kernels;
}

} // namespace metamarch
