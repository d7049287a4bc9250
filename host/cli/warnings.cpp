#include "metamarch/cli/warnings.h"

#include <fmt/format.h>

#include <cstdio>

namespace metamarch::cli {

void printWarning(const std::string& warning) { fmt::print(stderr, "metamarch: warning: {}\n", warning); }

void printWarnings(const Scene& scene) {
    for (const std::string& warning : scene.warnings) {
        printWarning(warning);
    }
}

void printWarnings(const Scene& scene, const AccelerationStructure& structure) {
    if (structure.degenerateTriangles != 0 && structure.degenerateTriangles == scene.triangles.size()) {
        printWarning(fmt::format(
            "all {} triangles are degenerate, nothing is visible; if the scene is tiny, use --scale",
            structure.degenerateTriangles));
    }
}

} // namespace metamarch::cli
