#include "cli/warnings.h"

#include <fmt/format.h>

#include <cstdio>

namespace metamarch::cli {
namespace {

void print(const std::string& warning) { fmt::print(stderr, "metamarch: warning: {}\n", warning); }

} // namespace

void printWarnings(const Scene& scene) {
    for (const std::string& warning : scene.warnings) {
        print(warning);
    }
}

void printWarnings(const Scene& scene, const AccelerationStructure& structure) {
    if (structure.degenerateTriangles != 0 && structure.degenerateTriangles == scene.triangles.size()) {
        print(fmt::format(
            "all {} triangles are degenerate, nothing is visible; if the scene is tiny, use --scale",
            structure.degenerateTriangles));
    }
}

} // namespace metamarch::cli
