#include "cli/structure_options.h"

#include "accel/partition_file.h"
#include "cli/number_list.h"
#include "error.h"
#include "shared/kd_node.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::cli {

void StructureOptions::addTo(CLI::App& command) {
    const std::string group = "Tree and table";
    command
        .add_option("--tree-depth", treeDepth,
                    "Deepest level of the kd-tree (default: from the triangle count)")
        ->type_name("D")
        ->group(group);
    CLI::Option* const unitOption =
        command.add_option("--unit", unit, "Unit length of the lattice in scene units, one or one per axis")
            ->type_name("U|Ux,Uy,Uz")
            ->group(group);
    CLI::Option* const cellsOption =
        command
            .add_option("--cells", cells,
                        "About how many cells the lattice has (default: from the triangle count)")
            ->type_name("N")
            ->excludes(unitOption)
            ->group(group);
    CLI::Option* const mergeOption =
        command.add_flag("--merge", merge, "Merge leaves of the table where that costs a ray no more")
            ->group(group);
    command
        .add_option("--partition", partitionPath,
                    "March these boxes of whole cells in place of the kd-tree's leaves")
        ->type_name("FILE.json")
        ->excludes(unitOption)
        ->excludes(cellsOption)
        ->excludes(mergeOption)
        ->group(group);
    command
        .add_flag("--no-exit-boxes", noExitBoxes,
                  "Leave each leaf by its own box, not by one grown over neighbours")
        ->group(group);
    command
        .add_option("--preset", preset,
                    "paper: kd-tree depth 16 and no exit boxes, as in the paper's experiment")
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
    options.exitBoxes = !noExitBoxes;
    options.mergeLeaves = merge;
    if (!partitionPath.empty()) {
        options.partition = readPartition(partitionPath);
    }
    if (preset == "paper") {
        options.treeDepth = treeDepth.value_or(kPaperTreeDepth);
        options.exitBoxes = false;
    }
    return options;
}

} // namespace metamarch::cli
