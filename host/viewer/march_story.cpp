// SPDX-License-Identifier: MIT
#include "metamarch/viewer/march_story.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::viewer {
namespace {

std::string numberOf(const std::size_t count, const char* const thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string cellText(const ivec3& cell) { return fmt::format("cell ({}, {}, {})", cell.x, cell.y, cell.z); }

// What the leaf holds, and what comes out of it before the exit.
std::string leafText(const MarchLog& march, const std::size_t index) {
    const MarchStep& step = march.steps[index];
    if (step.triangleCount == 0) {
        return "It is empty.";
    }
    const std::string holds = "It holds " + numberOf(step.triangleCount, "triangle");
    const std::uint32_t before = index == 0 ? kNoTriangle : march.steps[index - 1].best.triangleId;
    if (step.best.triangleId != before && !step.isFinal) {
        return fmt::format("{}; triangle {} is hit, but behind the exit, so a nearer one may come.", holds,
                           step.best.triangleId);
    }
    if (step.isFinal) {
        return holds + ".";
    }
    return step.tests == 0 ? holds + "; the ray meets none of their boxes."
                           : fmt::format("{}; {} tested, none is hit before the exit.", holds, step.tests);
}

} // namespace

std::string sentenceOf(const MarchLog& march, const std::size_t index) {
    const MarchStep& step = march.steps[index];
    const std::string begin = fmt::format("The ray is in {}. The table says: leaf {}. {} ",
                                          cellText(step.cell), step.leafId, leafText(march, index));
    if (step.isFinal) {
        return fmt::format(
            "{}Triangle {} is hit at {:.4g}, before the exit: nothing nearer can come. The march ends.",
            begin, step.best.triangleId, step.best.t);
    }
    if (index + 1 == march.steps.size()) {
        return begin + "Behind the exit the lattice ends: the ray hits nothing.";
    }
    const ivec3 size = step.exitBox.hi - step.exitBox.lo;
    return fmt::format("{}We leave the box of {} x {} x {} cells, and jump to {}.", begin, size.x, size.y,
                       size.z, cellText(march.steps[index + 1].cell));
}

std::string sentenceOf(const WalkLog& walk, const std::size_t index) {
    const WalkVisit& visit = walk.visits[index];
    const std::string waiting = numberOf(visit.stack.size(), "node");
    if (!visit.isLeaf) {
        const bool hasGrown =
            visit.stack.size() >
            (index == 0 ? 0 : walk.visits[index - 1].stack.size() - (walk.visits[index - 1].isLeaf ? 1 : 0));
        return hasGrown
                   ? fmt::format("Node {}: the ray meets both halves. The far one waits: {} on the stack.",
                                 visit.nodeId, waiting)
                   : fmt::format("Node {}: the ray meets one half. {} on the stack.", visit.nodeId, waiting);
    }
    const std::string leaf = fmt::format("A leaf with {}.", numberOf(visit.triangleCount, "triangle"));
    return index + 1 == walk.visits.size()
               ? leaf + " The walk ends."
               : fmt::format("{} We take the last of {} from the stack.", leaf, waiting);
}

std::size_t visitsUpTo(const WalkLog& walk, const MarchLog& march, const std::size_t step) {
    if (step + 1 == march.steps.size()) {
        return walk.visits.size();
    }
    // The visits go from near to far.
    const auto first = std::ranges::find_if(
        walk.visits, [&](const WalkVisit& visit) { return visit.tNear >= march.steps[step].tFar; });
    return static_cast<std::size_t>(first - walk.visits.begin());
}

} // namespace metamarch::viewer
