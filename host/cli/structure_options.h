// The options that shape tree and table, the same for every sub-command that builds them.
#pragma once
#include "metamarch/accel/options.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace metamarch::cli {

// The traversal that marches the tables of `method`.
std::string_view marchThrough(TableMethod method);

// Throws Error(invalidArgument) where `traversal` cannot go with what --table asks for: the rectilinear table
// has one traversal, and the others would walk what was not asked for.
void requireTable(TableMethod method, std::string_view traversal);

class StructureOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range and what readPartition throws.
    AccelerationOptions parse() const;

  private:
    TableMethod parseTable() const;

    std::string unit;
    std::string preset;
    std::optional<double> cells; // as a number: an unsigned integer would take -5 for 2^64 - 5
    std::optional<unsigned> treeDepth;
    bool noExitBoxes = false;
    bool merge = false;
    std::string partitionPath;
    std::string table;
    std::optional<double> quantum;
};

} // namespace metamarch::cli
