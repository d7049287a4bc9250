// SPDX-License-Identifier: MIT
#include "metamarch/cli/device_settings.h"

#include "metamarch/shaders/shader_library.h"

#include <fmt/format.h>

namespace metamarch::cli {

Setting& declareDevice(SettingList& list, std::string& device) {
    return list.text("device", device, "Vulkan device, see `metamarch devices`").takes("INDEX|NAME");
}

Setting& declareTraversal(SettingList& list, const std::string& name, std::string& traversal,
                          const std::string& help) {
    return list.word(name, traversal, traversalNames(), help).takes("NAME");
}

std::vector<std::string> traversalNames() { return {traversals().begin(), traversals().end()}; }

std::string_view marchThrough(const TableMethod method) {
    return method == TableMethod::rectilinear ? "rectilinear_table" : traversals().front();
}

void requireTable(const TableMethod method, const std::string_view traversal) {
    if (method == TableMethod::rectilinear && traversal != marchThrough(method)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("the rectilinear table is marched by {} alone, not by {}",
                                marchThrough(method), traversal),
                    {"table", "traversal"});
    }
}

} // namespace metamarch::cli
