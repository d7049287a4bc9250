// SPDX-License-Identifier: MIT
// A kernel that `translate` has made computes what its source computes as C++.
#include "control_flow.h"
#include "metamarch/processor/processor_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace metamarch {

void control_flow_baseline(const KernelInput& input);
#ifdef __x86_64__
void control_flow_avx2(const KernelInput& input);
void control_flow_avx512(const KernelInput& input);
#endif

namespace tests {
namespace {

constexpr std::uint32_t kSize = 64; // of a workgroup
constexpr std::uint32_t kUntouched = 0x12345678u;
constexpr std::uint32_t kFirstSum = 5;

constexpr Setting kPushed{3, 1000, 0.75f};
constexpr Setting kKept[] = {{99, 99, 99.0f}, {5, 4, 1.5f}};

struct Output {
    std::vector<glm::uvec4> results;
    std::vector<glm::uvec4> more;
    std::uint32_t sum;
};

// The kernel for each set of instructions that this processor has.
class Translate : public testing::TestWithParam<ProcessorKernel> {};

std::vector<ProcessorKernel> kernels() {
    return executable({
#ifdef __x86_64__
        {"avx512", control_flow_avx512},
        {"avx2", control_flow_avx2},
#endif
        {"baseline", control_flow_baseline},
    });
}

INSTANTIATE_TEST_SUITE_P(Kernels, Translate, testing::ValuesIn(kernels()),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Runs a kernel for whole workgroups.
Output run(const Kernel kernel, std::vector<std::uint32_t>& given) {
    Output output{std::vector(given.size(), glm::uvec4(kUntouched)),
                  std::vector(given.size(), glm::uvec4(kUntouched)), kFirstSum};
    KernelInput input{};
    input.buffers[0] = reinterpret_cast<char*>(given.data());
    input.buffers[1] = reinterpret_cast<char*>(output.results.data());
    input.buffers[2] = reinterpret_cast<char*>(output.more.data());
    input.buffers[3] = reinterpret_cast<char*>(&output.sum);
    input.buffers[4] = const_cast<char*>(reinterpret_cast<const char*>(kKept));
    input.push = reinterpret_cast<const char*>(&kPushed);
    input.invocations = kSize;
    for (input.workgroup = 0; input.workgroup < given.size() / kSize; ++input.workgroup) {
        kernel(input);
    }
    return output;
}

TEST_P(Translate, lanesComputeWhatTheSourceSays) {
    std::vector<std::uint32_t> given(std::size_t{kSize} * 1024);
    for (std::uint32_t i = 0; i < given.size(); ++i) {
        given[i] = i % 7 == 3 ? 0xffffffffu : i < 1000 ? i : i * 2654435761u >> (i % 23);
    }
    const Output output = run(GetParam().run, given);

    std::uint32_t expectedSum = kFirstSum;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const std::uint32_t x = given[i];
        if (x == 0xffffffffu) {
            ASSERT_EQ(output.results[i], glm::uvec4(kUntouched)) << "lanes that return write nothing";
            continue;
        }
        ASSERT_EQ(output.results[i].x, early(x)) << x;
        ASSERT_EQ(output.results[i].y, turns(x)) << x;
        ASSERT_EQ(output.results[i].z, nested(x)) << x;
        ASSERT_EQ(output.results[i].w, structs(x)) << x;
        ASSERT_EQ(output.more[i].x, numbers(x)) << x;
        ASSERT_EQ(output.more[i].z, outOfTwo(x)) << x;
        ASSERT_EQ(output.more[i].w, settings(kPushed, kKept[1], x)) << x;
        expectedSum += x;
    }
    EXPECT_EQ(output.sum, expectedSum);
}

// GLM's function keeps no NaN; IEEE 754's value of each half is written out here.
TEST_P(Translate, halvesHaveTheirValues) {
    std::vector<std::uint32_t> given(0x10000);
    for (std::uint32_t i = 0; i < given.size(); ++i) {
        given[i] = i;
    }
    const Output output = run(GetParam().run, given);
    const auto bitsOf = [](const std::uint32_t half) {
        const int exponent = static_cast<int>(half >> 10 & 31u);
        const auto mantissa = static_cast<float>(half & 1023u);
        const float value = exponent == 31  ? std::numeric_limits<float>::infinity()
                            : exponent == 0 ? std::ldexp(mantissa, -24)
                                            : std::ldexp(mantissa + 1024.0f, exponent - 25);
        return floatBitsToUint(value) | (half & 0x8000u) << 16;
    };
    for (std::uint32_t half = 0; half < given.size(); ++half) {
        if ((half & 0x7c00u) == 0x7c00u && (half & 1023u) != 0) {
            continue; // NaN
        }
        ASSERT_EQ(output.more[half].y, bitsOf(half) ^ (bitsOf(half ^ 0x8000u) * 3u)) << half;
    }
}

} // namespace
} // namespace tests
} // namespace metamarch
