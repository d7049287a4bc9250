// SPDX-License-Identifier: MIT
#include "metamarch/processor/processor_kernels.h"

#include "metamarch/shared/features.h"

namespace metamarch {

void path_baseline(const KernelInput& input);
void primary_baseline(const KernelInput& input);
void rays_baseline(const KernelInput& input);
#ifdef __x86_64__
void path_avx2(const KernelInput& input);
void path_avx512(const KernelInput& input);
void plain_path_avx2(const KernelInput& input);
void plain_path_avx512(const KernelInput& input);
void primary_avx2(const KernelInput& input);
void primary_avx512(const KernelInput& input);
void rays_avx2(const KernelInput& input);
void rays_avx512(const KernelInput& input);
#else
void plain_path_baseline(const KernelInput& input);
#endif

namespace {

constexpr std::uint32_t kRareFeatures =
    kBsdfFeatures | kFeatureAnisotropy | kFeatureDispersion | kFeatureCatcher | kFeatureThinGlass;
static_assert(kRareFeatures == METAMARCH_RARE_FEATURES, "RARE_FEATURES in CMakeLists.txt");

} // namespace

std::vector<ProcessorKernel> executable(std::vector<ProcessorKernel> kernels) {
#ifdef __x86_64__
    const bool hasAvx2 = __builtin_cpu_supports("avx2");
    const bool hasAvx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    std::erase_if(kernels, [&](const ProcessorKernel& kernel) {
        return (!hasAvx2 && kernel.name.ends_with("avx2")) || (!hasAvx512 && kernel.name.ends_with("avx512"));
    });
#endif
    return kernels;
}

std::vector<ProcessorKernel> pathKernels(const std::uint32_t features) {
    std::vector<ProcessorKernel> kernels = executable({
#ifdef __x86_64__
        {"plain_path_avx512", plain_path_avx512},
        {"path_avx512", path_avx512},
        {"plain_path_avx2", plain_path_avx2},
        {"path_avx2", path_avx2},
#else
        {"plain_path_baseline", plain_path_baseline},
#endif
        {"path_baseline", path_baseline},
    });
    if ((features & kRareFeatures) != 0) {
        std::erase_if(kernels,
                      [](const ProcessorKernel& kernel) { return kernel.name.starts_with("plain_"); });
    }
    return kernels;
}

std::vector<ProcessorKernel> primaryKernels() {
    return executable({
#ifdef __x86_64__
        {"primary_avx512", primary_avx512},
        {"primary_avx2", primary_avx2},
#endif
        {"primary_baseline", primary_baseline},
    });
}

std::vector<ProcessorKernel> rayKernels() {
    return executable({
#ifdef __x86_64__
        {"rays_avx512", rays_avx512},
        {"rays_avx2", rays_avx2},
#endif
        {"rays_baseline", rays_baseline},
    });
}

} // namespace metamarch
