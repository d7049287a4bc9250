// SPDX-License-Identifier: MIT
// Describes scene, tree and table in numbers, for `info` and for --stats.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/accel/rectilinear_table.h"
#include "metamarch/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

namespace metamarch::cli {

// Keys: vertices triangles degenerateTriangles bounds.min bounds.max lattice.resolution lattice.unit
// table.cells table.leaves tree.nodes tree.leaves tree.emptyLeaves tree.references tree.depth bytes.tree
// bytes.table bytes.exitBoxes bytes.referenceBoxes bytes.triangles seconds.tree seconds.table
// trianglesPerSecond; a dot opens an object. With --table gcd also planes.quantum planes.movedAtMost
// planes.quantaPerCell. tree.leaves counts the leaves that hold triangles, tree.emptyLeaves the others; the
// table's are all of them, unless it has leaves of its own. bounds are null without triangles.
nlohmann::ordered_json reportStructure(const Scene& scene, const AccelerationStructure& structure);

// Returns the object `rectilinear`, which --table rectilinear adds: planes (of each axis, both faces among
// them) cells leaves references depth bytes.table bytes.exitBoxes bytes.planes bytes.triangles seconds. depth
// is that of the tree whose planes they are; bytes.planes counts the look-ups too.
nlohmann::ordered_json reportRectilinear(const RectilinearTable& table);

} // namespace metamarch::cli
