// SPDX-License-Identifier: MIT
#include "metamarch/viewer/shader_reload.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace metamarch::viewer {

ShaderReload::ShaderReload(const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::is_directory(folder, error)) {
        compiler.emplace(folder);
        watch.watch({folder});
    }
}

std::string ShaderReload::compile(const std::vector<std::string>& traversals, const Memory memory) {
    std::vector<std::pair<std::string, std::string>> programs = {{"cells", ""}};
    for (const std::string& traversal : traversals) {
        programs.emplace_back("path", traversal);
        programs.emplace_back("inspect", traversal);
    }
    ShaderOverrides next;
    for (const auto& program : programs) {
        ShaderCompiler::Result result = compiler->compile(program.first, program.second, memory);
        if (result.spirv.empty()) {
            return result.error;
        }
        next.spirv.emplace(program, std::move(result.spirv));
    }
    current = std::move(next);
    return "";
}

bool ShaderReload::lacks(const std::vector<std::string>& traversals) const {
    return !current.spirv.empty() && std::ranges::any_of(traversals, [&](const std::string& traversal) {
        return current.find("path", traversal).empty();
    });
}

} // namespace metamarch::viewer
