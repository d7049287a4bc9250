// SPDX-License-Identifier: MIT
#include "metamarch/accel/partition_file.h"
#include "metamarch/settings/number_text.h"
#include "metamarch/settings/render_settings.h"
#include "metamarch/shared/kd_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace metamarch {
namespace {

constexpr std::pair<std::string_view, TableMethod> kTableMethods[] = {
    {"unit", TableMethod::unit}, {"gcd", TableMethod::gcd}, {"rectilinear", TableMethod::rectilinear}};

Setting::Access unitAccess(std::optional<glm::dvec3>& unit) {
    return {[&unit](const std::string& text) {
                const glm::dvec3 given = parseOneOrThree(text);
                if (!glm::all(glm::greaterThan(given, glm::dvec3(0.0)))) {
                    throw Error(ErrorKind::invalidArgument, "give a unit length greater than 0");
                }
                unit = given;
            },
            [&unit] { return unit ? fmt::format("{},{},{}", unit->x, unit->y, unit->z) : ""; }};
}

// Reads a real number, so that 1e6 is a count of cells, and so that -5 is refused and not taken for 2^64 - 5.
Setting::Access cellsAccess(std::optional<std::uint64_t>& cells) {
    static constexpr double kFarOverTheLimit = 0x1p62;
    return {[&cells](const std::string& text) {
                const double count = parseNumber(
                    text, {1.0, std::numeric_limits<double>::infinity(), "the number of cells, at least 1"});
                cells = static_cast<std::uint64_t>(std::min(count, kFarOverTheLimit));
            },
            [&cells] { return cells ? fmt::format("{}", *cells) : ""; }};
}

Setting::Access partitionAccess(std::optional<Partition>& partition) {
    const auto path = std::make_shared<std::string>();
    return {[&partition, path](const std::string& text) {
                partition = readPartition(text);
                *path = text;
            },
            [path] { return *path; }};
}

Setting::Access presetAccess(AccelerationOptions& options) {
    const auto preset = std::make_shared<std::string>();
    return {[&options, preset](const std::string& text) {
                options.treeDepth = options.treeDepth.value_or(kPaperTreeDepth);
                options.exitBoxes = false;
                *preset = text;
            },
            [preset] { return *preset; }};
}

} // namespace

void declareStructure(SettingList& list, AccelerationOptions& options) {
    list.beginGroup("Tree and table");
    list.count("tree-depth", options.treeDepth, 0, kMaxTreeDepth,
               "Deepest level of the kd-tree (default: from the number of triangles)")
        .withValueName("D");
    list.add("unit", Setting::Kind::value, unitAccess(options.unit),
             "Unit length of the lattice in scene units, one or one per axis")
        .withValueName("U|Ux,Uy,Uz")
        .excludes({"cells", "partition"});
    list.add("cells", Setting::Kind::value, cellsAccess(options.cells),
             "About how many cells the lattice has (default: from the number of triangles)")
        .withValueName("N")
        .excludes({"unit", "partition"});
    list.choice(
        "table", options.table, kTableMethods,
        "How the table comes to its cells. unit: from --unit or --cells, and the tree after it; gcd: "
        "from the planes of a finished tree, by their greatest common divisors; rectilinear: the uneven "
        "cells between the planes of a finished tree, the deepest that fits");
    list.number("quantum", options.quantum,
                {std::numeric_limits<double>::min(), std::numeric_limits<double>::max(),
                 "a length greater than 0"},
                "With --table gcd: planes are rounded to multiples of Q scene units (default: 1/256 of the "
                "longest side)")
        .withValueName("Q")
        .needs({"table"});
    list.flag("merge", options.mergeLeaves, "Merge leaves of the table where that costs a ray no more")
        .excludes({"partition"});
    list.add("partition", Setting::Kind::value, partitionAccess(options.partition),
             "March these boxes of whole cells in place of the kd-tree's leaves")
        .withValueName("FILE.json")
        .excludes({"unit", "cells", "merge"});
    list.flagOff("no-exit-boxes", options.exitBoxes,
                 "Leave each leaf by its own box, not by one grown over neighbours");
    list.add("preset", Setting::Kind::value, presetAccess(options),
             "paper: kd-tree depth 16 and no exit boxes, as in the paper's experiment")
        .withValueName("NAME")
        .oneOf({"paper"});
}

void checkStructure(const AccelerationOptions& options) {
    const auto refuse = [](const char* line, std::vector<std::string> settings) {
        throw Error(ErrorKind::invalidArgument, line, std::move(settings));
    };
    if (options.table != TableMethod::unit && (options.unit || options.cells || options.partition)) {
        refuse("this table takes its cells from the tree's planes: a unit length, a number of cells and a "
               "partition exclude it",
               {"table", "unit", "cells", "partition"});
    }
    if (options.table == TableMethod::rectilinear && options.mergeLeaves) {
        refuse("merging joins leaves of even cells: a rectilinear table excludes it", {"merge", "table"});
    }
    if (options.quantum && options.table != TableMethod::gcd) {
        refuse("a quantum is for the gcd table alone", {"quantum", "table"});
    }
}

} // namespace metamarch
