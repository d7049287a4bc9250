// SPDX-License-Identifier: MIT
// The SPIR-V that the program holds, judged by the validator of Khronos.
#include "metamarch/shaders/shader_library.h"

#include <gtest/gtest.h>

#include <spirv-tools/libspirv.hpp>
#include <span>
#include <string>
#include <vector>

namespace metamarch {
namespace tests {
namespace {

// Returns what is wrong with a module; empty if it is valid for the Vulkan that the program asks for.
std::string faultsOf(const std::vector<uint32_t>& spirv) {
    std::string faults;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    tools.SetMessageConsumer([&](auto, auto, auto, const char* message) { faults.append(message) += '\n'; });
    if (!tools.Validate(spirv) && faults.empty()) {
        faults = "not valid";
    }
    return faults;
}

TEST(Spirv, isValidInEveryShader) {
    for (const Shader& shader : shaders()) {
        EXPECT_EQ(faultsOf({shader.spirv.begin(), shader.spirv.end()}), "")
            << shader.kernel << ' ' << shader.traversal;
    }
}

TEST(Spirv, isJudgedByAValidatorThatFindsFaults) {
    const std::span<const uint32_t> words = shaders().front().spirv;
    std::vector<uint32_t> cut(words.begin(), words.end());
    cut.pop_back();
    EXPECT_NE(faultsOf(cut), "");
}

} // namespace
} // namespace tests
} // namespace metamarch
