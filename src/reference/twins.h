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

// What <name>.cpp of a twin defines: metamarch::<name>::kLoop, one loop compiled twice.
struct TwinLoop {
    TwinFunction* checked;   // throws std::logic_error where an invariant of the loop is broken
    TwinFunction* unchecked; // for benchmarks
};

struct Twin {
    std::string_view traversal; // the name in traversals()
    TwinLoop loop;
};

// In the order of src/reference/CMakeLists.txt.
std::span<const Twin> twins();

// Not those that leave the walk to the driver.
bool hasTwin(std::string_view traversal);

// Throws std::out_of_range for a traversal without a twin.
const TwinLoop& findTwin(std::string_view traversal);

} // namespace metamarch
