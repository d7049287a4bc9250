// SPDX-License-Identifier: MIT
// Recompiles shaders while the user edits them.
#pragma once
#include "metamarch/viewer/file_watch.h"
#include "metamarch/viewer/shader_compiler.h"
#include "metamarch/viewer/shader_overrides.h"

#include <optional>
#include <string>
#include <vector>

namespace metamarch::viewer {

class ShaderReload {
  public:
    // Watches `folder`. If it is not a folder, hasChanged() is always false.
    explicit ShaderReload(const std::filesystem::path& folder);

    std::filesystem::path folder() const { return compiler ? compiler->folder() : std::filesystem::path(); }

    bool hasChanged() { return compiler && watch.hasChanged(); }

    // Compiles the kernels that the viewer uses, for `traversals` only. If that fails, returns the compiler's
    // messages and leaves the overrides as they were; otherwise returns an empty text.
    std::string compile(const std::vector<std::string>& traversals, Memory memory);

    // Returns true if there are overrides, but not for all of `traversals`.
    bool lacks(const std::vector<std::string>& traversals) const;

    const ShaderOverrides& overrides() const { return current; }

  private:
    std::optional<ShaderCompiler> compiler;
    FileWatch watch;
    ShaderOverrides current;
};

} // namespace metamarch::viewer
