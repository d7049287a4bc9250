// Shaders compiled anew while somebody edits them.
#pragma once
#include "viewer/file_watch.h"
#include "viewer/shader_compiler.h"
#include "viewer/shader_overrides.h"

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

    // Compiles what draws with these traversals. Returns the compiler's words where that fails, and leaves
    // the overrides as they were.
    std::string compile(const std::vector<std::string>& traversals, Memory memory);

    const ShaderOverrides& overrides() const { return current; }

  private:
    std::optional<ShaderCompiler> compiler;
    FileWatch watch;
    ShaderOverrides current;
};

} // namespace metamarch::viewer
