// SPDX-License-Identifier: MIT
#include "metamarch/accel/split.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

namespace metamarch {
namespace {

// With fewer references, sweeping the three axes serially is faster than distributing the work.
constexpr std::size_t kParallelReferences = 1u << 14u;

std::optional<Split> sweepAxis(const std::span<const TriangleReference> references, const CellRange& box,
                               const glm::dvec3& cellSize, const unsigned axis) {
    const unsigned first = box.lo[axis];
    const unsigned planes = static_cast<unsigned>(box.hi[axis] - box.lo[axis]);
    if (planes == 0) {
        return std::nullopt;
    }
    // begins[i] and ends[i] count the references whose first and last cell is first + i. With them the counts
    // on both sides of every plane are exact.
    std::array<std::vector<std::uint32_t>, 2> histograms;
    auto& [begins, ends] = histograms;
    begins.resize(planes + 1);
    ends.resize(planes + 1);
    for (const TriangleReference& reference : references) {
        ++begins[reference.cells.lo[axis] - first];
        ++ends[reference.cells.hi[axis] - first];
    }

    glm::dvec3 size;
    for (std::size_t i = 0; i < 3; ++i) {
        size[static_cast<int>(i)] = (box.hi[i] - box.lo[i] + 1) * cellSize[static_cast<int>(i)];
    }
    const SplitCost costOf(size, axis);
    std::optional<Split> best;
    std::size_t below = 0;
    std::size_t above = references.size();
    for (unsigned i = 0; i < planes; ++i) { // the plane lies between cells first + i and first + i + 1
        below += begins[i];
        above -= ends[i];
        const double cost = costOf((i + 1) * cellSize[static_cast<int>(axis)], below, above);
        if (!best || cost < best->cost) {
            best = Split{axis, static_cast<std::uint16_t>(first + i + 1), cost};
        }
    }
    return best;
}

} // namespace

std::optional<Split> findSplit(const std::span<const TriangleReference> references, const CellRange& box,
                               const glm::dvec3& cellSize) {
    std::array<std::optional<Split>, 3> candidates;
    const auto sweep = [&](const unsigned axis) {
        candidates[axis] = sweepAxis(references, box, cellSize, axis);
    };
    if (references.size() >= kParallelReferences) {
        tbb::parallel_for(0u, 3u, sweep);
    } else {
        for (unsigned axis = 0; axis < 3; ++axis) {
            sweep(axis);
        }
    }
    std::optional<Split> best;
    for (const std::optional<Split>& candidate : candidates) {
        if (candidate && (!best || candidate->cost < best->cost)) {
            best = candidate;
        }
    }
    return best;
}

} // namespace metamarch
