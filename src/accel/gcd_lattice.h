// Method 2 of the paper: a finished kd-tree first, then the unit lengths that all of its planes are multiples
// of. Greatest common divisors of floats mean nothing, so planes are rounded to multiples of a quantum.
#pragma once
#include "metamarch/accel/lattice.h"
#include "metamarch/accel/split_plan.h"

namespace metamarch {

// How far the planes of a finished tree were moved to reach a lattice.
struct PlaneRounding {
    double quantum;           // scene units, as far as single precision goes
    double farthest;          // scene units; no plane was moved farther: half a quantum, and the
                              // rounding of the lattice itself
    glm::uvec3 quantaPerCell; // the divisors
};

struct GcdLattice {
    Lattice lattice;
    SplitPlan plan; // its planes by their numbers in the lattice
    PlaneRounding rounding;
};

// The lattice for `plan`, which was made in the space of `quanta`. A plane that is rounded to the face of its
// node is left out. Throws Error(outOfMemory), naming the size, for more than kMaxLatticeResolution cells on
// an axis or a table over kTableBudget.
GcdLattice makeGcdLattice(const Lattice& quanta, const SplitPlan& plan);

} // namespace metamarch
