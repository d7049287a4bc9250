// SPDX-License-Identifier: MIT
// The compiled shaders, embedded in the program: shaders/CMakeLists.txt lists kernels and traversals.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace metamarch {

// What the scene's arrays are to a shader: lib/memory.glsl.
enum class Memory { storage, texel };

struct Shader {
    std::string_view kernel;
    std::string_view traversal; // empty: the kernel needs none
    std::string_view
        structure; // that the traversal walks, or whose triangle records the kernel reads, if any
    Memory memory;
    std::span<const std::uint32_t> spirv;
};

// Every kernel with every traversal, then the kernels that need none; each for both kinds of memory, those
// that read no scene for storage alone.
std::span<const Shader> shaders();

// The names that --traversal takes, the default first.
std::span<const std::string_view> traversals();

// The structure that a traversal walks, or that a kernel reads which takes no traversal; empty where there is
// none.
std::string_view structureOf(std::string_view name);

} // namespace metamarch
