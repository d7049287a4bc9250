// The compiled shaders, embedded in the program: shaders/CMakeLists.txt lists kernels and traversals.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace metamarch {

struct Shader {
    std::string_view kernel;
    std::string_view traversal;
    std::string_view structure; // that the traversal walks
    std::span<const std::uint32_t> spirv;
};

// Every kernel with every traversal.
std::span<const Shader> shaders();

// The names that --traversal takes, the default first.
std::span<const std::string_view> traversals();

} // namespace metamarch
