// SPDX-License-Identifier: MIT
// Method 2 of the paper: build the kd-tree first, then find the unit lengths of which all its planes are
// multiples. The greatest common divisor of floats has no meaning, so planes are first rounded to multiples
// of a quantum.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/split_plan.h"

namespace metamarch {

// How far the planes of a finished tree were moved to lie on a lattice.
struct PlaneRounding {
    double quantum; // scene units, within single precision
    // Scene units; upper bound on how far any plane was moved: half a quantum plus the rounding of the
    // lattice itself.
    double farthest;
    glm::uvec3 quantaPerCell; // the greatest common divisors, per axis
};

struct GcdLattice {
    Lattice lattice;
    SplitPlan plan; // planes are given by their index in the lattice
    PlaneRounding rounding;
};

// Makes the lattice for `plan`, which was made in the space of `quanta`. Drops each split whose plane rounds
// to a face of its node. Throws Error(outOfMemory), naming the size, if an axis needs more than
// kMaxLatticeResolution cells or the table more than kTableBudget bytes.
GcdLattice makeGcdLattice(const Lattice& quanta, const SplitPlan& plan);

} // namespace metamarch
