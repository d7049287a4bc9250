#include "metamarch/cli/structure_options.h"

#include "metamarch/accel/partition_file.h"
#include "metamarch/cli/number_list.h"
#include "metamarch/error/error.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shared/kd_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace metamarch::cli {

std::string_view marchThrough(const TableMethod method) {
    return method == TableMethod::rectilinear ? "rectilinear_table" : traversals().front();
}

void requireTable(const TableMethod method, const std::string_view traversal) {
    if (method == TableMethod::rectilinear && traversal != marchThrough(method)) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--table rectilinear is marched by {} alone, not by {}", marchThrough(method),
                                traversal));
    }
}

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
    command
        .add_option(
            "--table", table,
            "How the table comes to its cells. unit: from --unit or --cells, and the tree after it; gcd: "
            "from the planes of a finished tree, by their greatest common divisors; rectilinear: the uneven "
            "cells between the planes of a finished tree, the deepest that fits (default unit)")
        ->check(CLI::IsMember({"unit", "gcd", "rectilinear"}))
        ->group(group);
    command
        .add_option(
            "--quantum", quantum,
            "With --table gcd: planes are rounded to multiples of Q scene units (default: 1/256 of the "
            "longest side)")
        ->type_name("Q")
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

TableMethod StructureOptions::parseTable() const {
    const auto refuse = [](const std::string& line) { throw Error(ErrorKind::invalidArgument, line); };
    const TableMethod method = table == "gcd"           ? TableMethod::gcd
                               : table == "rectilinear" ? TableMethod::rectilinear
                                                        : TableMethod::unit;
    if (method != TableMethod::unit && (!unit.empty() || cells || !partitionPath.empty())) {
        refuse(fmt::format(
            "--table {} takes its cells from the tree's planes: --unit, --cells and --partition exclude it",
            table));
    }
    if (method == TableMethod::rectilinear && merge) {
        refuse("--merge joins leaves of even cells: --table rectilinear excludes it");
    }
    if (quantum && method != TableMethod::gcd) {
        refuse("--quantum is for --table gcd");
    }
    if (quantum && !(*quantum > 0.0 && std::isfinite(*quantum))) {
        refuse(fmt::format("--quantum {}: give a length greater than 0", *quantum));
    }
    return method;
}

AccelerationOptions StructureOptions::parse() const {
    AccelerationOptions options;
    if (!unit.empty()) {
        options.unit = parseOneOrThree("--unit", unit);
        if (!(options.unit->x > 0.0 && options.unit->y > 0.0 && options.unit->z > 0.0)) {
            throw Error(ErrorKind::invalidArgument,
                        fmt::format("--unit {}: a unit length is greater than 0", unit));
        }
    }
    if (cells && !(*cells >= 1.0)) { // NaN too
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--cells {}: a lattice has at least one cell", *cells));
    }
    if (treeDepth && *treeDepth > kMaxTreeDepth) {
        throw Error(ErrorKind::invalidArgument,
                    fmt::format("--tree-depth {}: the limit is {}", *treeDepth, kMaxTreeDepth));
    }
    if (cells) {
        options.cells = static_cast<std::uint64_t>(std::min(*cells, 0x1p62)); // far over the limit
    }
    options.table = parseTable();
    options.quantum = quantum;
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
