// SPDX-License-Identifier: MIT
// The CPU twins of the traversals of shaders/traversal: the same algorithm, step for step, with the same
// counters.
#pragma once
#include "metamarch/accel/structure_set.h"
#include "metamarch/reference/trace.h"

#include <span>
#include <string_view>

namespace metamarch {

using TwinFunction = TraceResult(const StructureSet& structures, const Ray& ray, HitQuery query);

// One loop, compiled twice. Each twin's <name>.cpp defines metamarch::<name>::kLoop.
struct TwinLoop {
    TwinFunction* checked;   // throws std::logic_error if an invariant of the loop does not hold
    TwinFunction* unchecked; // for benchmarks
};

struct Twin {
    std::string_view traversal; // the name in traversals()
    TwinLoop loop;
};

// Returns all twins in the order of src/reference/CMakeLists.txt.
std::span<const Twin> twins();

// Returns false for traversals that leave the walk to the driver.
bool hasTwin(std::string_view traversal);

// Throws std::out_of_range for a traversal without a twin.
const TwinLoop& findTwin(std::string_view traversal);

} // namespace metamarch
