// What the user should know of a scene that is read all the same: on stderr, a line each.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/scene/scene.h"

#include <string>

namespace metamarch::cli {

// What the importer left out or repaired.
// One line on stderr.
void printWarning(const std::string& warning);

void printWarnings(const Scene& scene);

// A scene whose triangles are all degenerate: its picture is empty.
void printWarnings(const Scene& scene, const AccelerationStructure& structure);

} // namespace metamarch::cli
