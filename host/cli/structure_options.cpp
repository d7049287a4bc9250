#include "cli/structure_options.h"

#include "cli/number_list.h"
#include "error.h"
#include "shared/kd_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace metamarch::cli {

void StructureOptions::addTo(CLI::App& command) {
    const std::string group = "Tree and table";
    command.add_option("--scale", scaleFactor, "Multiply the scene by S")->type_name("S")->group(group);
    command
        .add_option("--tree-depth", treeDepth,
                    "Deepest level of the kd-tree (default: from the triangle count)")
        ->type_name("D")
        ->group(group);
    CLI::Option* const unitOption =
        command.add_option("--unit", unit, "Unit length of the lattice in scene units, one or one per axis")
            ->type_name("U|Ux,Uy,Uz")
            ->group(group);
    command
        .add_option("--cells", cells,
                    "About how many cells the lattice has (default: from the triangle count)")
        ->type_name("N")
        ->excludes(unitOption)
        ->group(group);
    command.add_option("--preset", preset, "paper: kd-tree depth 16, as in the paper's experiment")
        ->type_name("NAME")
        ->check(CLI::IsMember({"paper"}))
        ->group(group);
}

AccelerationOptions StructureOptions::parse() const {
    AccelerationOptions options;
    if (!unit.empty()) {
        options.unit = parseOneOrThree("--unit", unit);
        if (!(options.unit->x > 0.0 && options.unit->y > 0.0 && options.unit->z > 0.0)) {
            throw Error(ExitCode::badArguments,
                        fmt::format("--unit {}: a unit length is greater than 0", unit));
        }
    }
    if (cells && !(*cells >= 1.0)) { // NaN too
        throw Error(ExitCode::badArguments,
                    fmt::format("--cells {}: a lattice has at least one cell", *cells));
    }
    if (treeDepth && *treeDepth > kMaxTreeDepth) {
        throw Error(ExitCode::badArguments,
                    fmt::format("--tree-depth {}: the limit is {}", *treeDepth, kMaxTreeDepth));
    }
    if (cells) {
        options.cells = static_cast<std::uint64_t>(std::min(*cells, 0x1p62)); // far over the limit
    }
    options.treeDepth = treeDepth;
    if (preset == "paper" && !treeDepth) {
        options.treeDepth = kPaperTreeDepth;
    }
    return options;
}

float StructureOptions::scale() const {
    const auto factor = static_cast<float>(scaleFactor);
    if (!std::isfinite(factor) || factor == 0.0f) {
        throw Error(ExitCode::badArguments,
                    fmt::format("--scale {}: give a finite number other than 0", scaleFactor));
    }
    return factor;
}

} // namespace metamarch::cli
