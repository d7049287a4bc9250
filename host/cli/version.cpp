// SPDX-License-Identifier: MIT
#include "metamarch/cli/version.h"

#include "git_commit.h"

#include <CLI/Version.hpp>
#include <OpenImageIO/oiioversion.h>
#include <fmt/format.h>
#include <glm/detail/setup.hpp>
#include <tbb/version.h>
#include <vulkan/vulkan_core.h>

namespace metamarch::cli {

std::string gitCommit() { return METAMARCH_GIT_COMMIT; }

std::string programVersion() { return fmt::format("metamarch {} ({})", METAMARCH_VERSION, gitCommit()); }

std::string versionText() {
    constexpr std::uint32_t vulkan = VK_HEADER_VERSION_COMPLETE;
    std::string text = programVersion() + "\n";
    const auto add = [&text](const char* name, const std::string& version) {
        text += fmt::format("{:<16}{}\n", name, version);
    };
    add("Vulkan headers", fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(vulkan), VK_API_VERSION_MINOR(vulkan),
                                      VK_API_VERSION_PATCH(vulkan)));
    add("GLM", fmt::format("{}.{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH,
                           GLM_VERSION_REVISION));
    add("OpenImageIO", fmt::format("{}.{}.{}", OIIO_VERSION_MAJOR, OIIO_VERSION_MINOR, OIIO_VERSION_PATCH));
    add("tinygltf", METAMARCH_TINYGLTF_VERSION);
    add("oneTBB", fmt::format("{}.{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH));
    add("CLI11", CLI11_VERSION);
    add("compiler", METAMARCH_COMPILER);
    text.pop_back();
    return text;
}

} // namespace metamarch::cli
