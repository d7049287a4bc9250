// SPDX-License-Identifier: MIT
#include "metamarch/render/traversal_choice.h"

#include "metamarch/error/error.h"
#include "metamarch/shaders/shader_library.h"

#include <fmt/format.h>

namespace metamarch::render {
namespace {

constexpr std::string_view kFastestOnCpu = "meta_table";

} // namespace

std::string_view marchingTraversal(const TableMethod method) {
    return method == TableMethod::rectilinear ? "rectilinear_table" : traversals().front();
}

void requireTable(const TableMethod method, const std::string_view traversal) {
    if (method == TableMethod::rectilinear && traversal != marchingTraversal(method)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("the rectilinear table is marched by {} alone, not by {}",
                                marchingTraversal(method), traversal),
                    {"table", "traversal"});
    }
}

bool isOnCpu(const std::string_view traversal) {
    return traversal == kFastestOnCpu || traversal == "kd_stack";
}

std::string traversalOnCpu(const std::string& wanted) {
    if (!wanted.empty() && !isOnCpu(wanted)) {
        throw Error(
            ErrorKind::invalidArgument,
            fmt::format("on the cpu there are kd_stack and {}; {} is for the gpu", kFastestOnCpu, wanted),
            {"backend", "traversal"});
    }
    return wanted.empty() ? std::string(kFastestOnCpu) : wanted;
}

} // namespace metamarch::render
