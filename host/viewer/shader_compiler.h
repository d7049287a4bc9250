// SPDX-License-Identifier: MIT
// Compiles GLSL to SPIR-V at run time with glslang, as the build does, but without spirv-opt.
#pragma once
#include "metamarch/shaders/shader_library.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace metamarch::viewer {

// At most one may exist at a time.
class ShaderCompiler {
  public:
    // `folder` has the same layout as the project's shaders/.
    explicit ShaderCompiler(std::filesystem::path folder);
    ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    struct Result {
        std::vector<std::uint32_t> spirv; // empty: the compilation failed
        std::string error;                // the compiler's messages, with file and line; several lines
    };
    // `traversal` is empty if the kernel needs none or has its own.
    Result compile(const std::string& kernel, const std::string& traversal, Memory memory) const;

    const std::filesystem::path& folder() const { return root; }

  private:
    std::filesystem::path root;
};

} // namespace metamarch::viewer
