// SPDX-License-Identifier: MIT
#include "metamarch/accel/gcd_lattice.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace metamarch {
namespace {

constexpr const char* kHint = "choose a larger quantum or a smaller tree depth";

// Rounds the planes below a node with the box [lo, hi), in quanta, and appends the remaining nodes of its
// subtree to `rounded`. The recursion is at most kMaxTreeDepth deep.
void roundBelow(const SplitPlan& plan, std::uint32_t nodeId, const glm::dvec3& lo, const glm::dvec3& hi,
                const unsigned depth, SplitPlan& rounded) {
    double plane = 0.0;
    while (plan.nodes[nodeId].axis != kNoSplit) {
        const PlannedNode& node = plan.nodes[nodeId];
        plane = std::round(node.plane);
        if (plane <= lo[static_cast<int>(node.axis)]) {
            nodeId = node.above;
        } else if (plane >= hi[static_cast<int>(node.axis)]) {
            nodeId = nodeId + 1;
        } else {
            break;
        }
    }
    const PlannedNode& node = plan.nodes[nodeId];
    const std::size_t index = rounded.nodes.size();
    rounded.nodes.push_back({node.axis, plane, 0});
    rounded.depth = std::max(rounded.depth, depth);
    if (node.axis == kNoSplit) {
        return;
    }
    const int axis = static_cast<int>(node.axis);
    glm::dvec3 middleHi = hi;
    glm::dvec3 middleLo = lo;
    middleHi[axis] = plane;
    middleLo[axis] = plane;
    roundBelow(plan, nodeId + 1, lo, middleHi, depth + 1, rounded);
    rounded.nodes[index].above = static_cast<std::uint32_t>(rounded.nodes.size());
    roundBelow(plan, node.above, middleLo, hi, depth + 1, rounded);
}

// Returns the greatest common divisor of all planes on each axis; on an axis without planes, one cell spans
// the whole side.
glm::uvec3 greatestDivisors(const SplitPlan& plan, const glm::uvec3 resolution) {
    glm::uvec3 divisors(0);
    for (const PlannedNode& node : plan.nodes) {
        if (node.axis != kNoSplit) {
            std::uint32_t& divisor = divisors[static_cast<int>(node.axis)];
            divisor = std::gcd(divisor, static_cast<std::uint32_t>(node.plane));
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        divisors[axis] = divisors[axis] == 0 ? resolution[axis] : divisors[axis];
    }
    return divisors;
}

// The cells must contain the box of the quanta; the rounding here cannot make it smaller.
Lattice inCells(const Lattice& quanta, const glm::uvec3 counts, const glm::uvec3 quantaPerCell) {
    Lattice lattice = quanta;
    lattice.resolution = counts;
    lattice.cellCount = counts.x * counts.y * counts.z;
    lattice.extent = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const double exact = static_cast<double>(quanta.cellsPerUnit[axis]) / quantaPerCell[axis];
        const auto nearest = static_cast<float>(exact);
        lattice.cellsPerUnit[axis] = nearest > exact ? std::nextafter(nearest, 0.0f) : nearest;
        const double side = counts[axis] / static_cast<double>(lattice.cellsPerUnit[axis]);
        lattice.extent = std::max(lattice.extent, static_cast<float>(side));
    }
    return lattice;
}

} // namespace

GcdLattice makeGcdLattice(const Lattice& quanta, const SplitPlan& plan) {
    GcdLattice result;
    roundBelow(plan, 0, glm::dvec3(0.0), glm::dvec3(quanta.resolution), 0, result.plan);
    const glm::uvec3 divisors = greatestDivisors(result.plan, quanta.resolution);
    for (PlannedNode& node : result.plan.nodes) {
        if (node.axis != kNoSplit) {
            node.plane /= divisors[static_cast<int>(node.axis)];
        }
    }
    const glm::uvec3 counts = (quanta.resolution + divisors - 1u) / divisors;
    if (std::max({counts.x, counts.y, counts.z}) > kMaxLatticeResolution) {
        throw Error(
            ErrorKind::outOfMemory,
            fmt::format("the tree's planes ask for {} x {} x {} cells ({:.0f} MiB), and a lattice has "
                        "at most {} on an axis; {}",
                        counts.x, counts.y, counts.z,
                        1.0 * counts.x * counts.y * counts.z * sizeof(std::uint32_t) / 0x1p20,
                        kMaxLatticeResolution, kHint),
            {"quantum", "treeDepth"});
    }

    result.lattice = inCells(quanta, counts, divisors);
    const glm::dvec3 quantum = 1.0 / glm::dvec3(quanta.cellsPerUnit);
    const double longest = std::max({quantum.x, quantum.y, quantum.z});
    result.rounding = {longest, 0.5 * longest + 0x1p-23 * static_cast<double>(result.lattice.extent),
                       divisors};
    return result;
}

} // namespace metamarch
