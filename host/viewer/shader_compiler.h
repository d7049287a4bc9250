// SPDX-License-Identifier: MIT
// GLSL to SPIR-V while the program runs, as the build does it: through glslang.
#pragma once
#include "metamarch/shaders/shader_library.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace metamarch::viewer {

// One at a time.
class ShaderCompiler {
  public:
    // `folder` holds what the project's shaders/ does.
    explicit ShaderCompiler(std::filesystem::path folder);
    ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    struct Result {
        std::vector<std::uint32_t> spirv; // empty: it failed
        std::string error;                // of the compiler, with file and line; several lines
    };
    // `traversal` empty: the kernel needs none, or has its own.
    Result compile(const std::string& kernel, const std::string& traversal, Memory memory) const;

    const std::filesystem::path& folder() const { return root; }

  private:
    std::filesystem::path root;
};

} // namespace metamarch::viewer
