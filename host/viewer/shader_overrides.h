// SPDX-License-Identifier: MIT
// Shaders that replace the embedded ones while the user edits them.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace metamarch::viewer {

struct ShaderOverrides {
    std::map<std::pair<std::string, std::string>, std::vector<std::uint32_t>> spirv; // [kernel, traversal]

    // Returns the replacement, or nothing if there is none.
    std::span<const std::uint32_t> find(const std::string& kernel, const std::string& traversal) const {
        const auto found = spirv.find({kernel, traversal});
        return found == spirv.end() ? std::span<const std::uint32_t>() : found->second;
    }
};

} // namespace metamarch::viewer
