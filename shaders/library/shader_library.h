// SPDX-License-Identifier: MIT
// The compiled shaders that are embedded in the program. shaders/CMakeLists.txt lists kernels and traversals.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace metamarch {

// The kind of buffer through which a shader reads the scene's arrays: lib/memory.glsl.
enum class Memory { storage, texel };

struct Shader {
    std::string_view kernel;
    std::string_view traversal; // empty: the kernel needs none
    // The structure that the traversal walks, or whose triangle records the kernel reads; empty: none.
    std::string_view structure;
    Memory memory;
    std::span<const std::uint32_t> spirv;
};

// Returns every kernel with every traversal, then the kernels that need none. Each is there for both kinds of
// memory, but kernels that read no scene for storage only.
std::span<const Shader> shaders();

// Returns the names of the traversals; the first one is the default.
std::span<const std::string_view> traversals();

// Returns the structure that a traversal walks, or that a kernel without a traversal reads. Returns an empty
// text if there is none.
std::string_view structureOf(std::string_view name);

} // namespace metamarch
