// SPDX-License-Identifier: MIT
// Shaders compiled anew while somebody edits them.
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
    // Watches `folder` where it is one; else nothing ever changes.
    explicit ShaderReload(const std::filesystem::path& folder);

    std::filesystem::path folder() const { return compiler ? compiler->folder() : std::filesystem::path(); }

    bool hasChanged() { return compiler && watch.hasChanged(); }

    // Compiles what draws with these traversals alone. Returns the compiler's words where that fails, and
    // leaves the overrides as they were.
    std::string compile(const std::vector<std::string>& traversals, Memory memory);

    // Whether shaders were compiled anew, but not those of all of these.
    bool lacks(const std::vector<std::string>& traversals) const;

    const ShaderOverrides& overrides() const { return current; }

  private:
    std::optional<ShaderCompiler> compiler;
    FileWatch watch;
    ShaderOverrides current;
};

} // namespace metamarch::viewer
