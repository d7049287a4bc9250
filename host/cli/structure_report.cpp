// SPDX-License-Identifier: MIT
#include "metamarch/cli/structure_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace metamarch::cli {
namespace {

template <class Vector>
nlohmann::ordered_json toArray(const Vector& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

// Returns the double that prints as briefly as the float: -0.0946899, not -0.09468989819288254.
double shortest(const float value) {
    const std::string text = fmt::format("{}", value);
    double result = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

glm::dvec3 shortest(const glm::vec3 v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }

template <class T>
std::size_t byteSize(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

} // namespace

nlohmann::ordered_json reportStructure(const Scene& scene, const AccelerationStructure& structure) {
    const KdTree& tree = structure.tree;
    const Bounds bounds = boundsOf(scene);
    const bool empty = scene.triangles.empty();
    const auto emptyLeaves = static_cast<std::size_t>(std::count_if(
        tree.leaves.begin(), tree.leaves.end(), [](const Leaf& leaf) { return leaf.triangleCount == 0; }));
    const double seconds = structure.treeSeconds + structure.tableSeconds;

    nlohmann::ordered_json report;
    report["vertices"] = scene.positions.size();
    report["triangles"] = scene.triangles.size();
    report["degenerateTriangles"] = structure.degenerateTriangles;
    report["bounds"]["min"] = empty ? nlohmann::ordered_json() : toArray(shortest(bounds.lo));
    report["bounds"]["max"] = empty ? nlohmann::ordered_json() : toArray(shortest(bounds.hi));
    report["lattice"]["resolution"] = toArray(structure.lattice.resolution);
    report["lattice"]["unit"] = toArray(structure.unit);
    report["table"]["cells"] = structure.lattice.cellCount;
    report["table"]["leaves"] = structure.table.leaves.size();
    if (structure.rounding) {
        report["planes"]["quantum"] = structure.rounding->quantum;
        report["planes"]["movedAtMost"] = structure.rounding->farthest;
        report["planes"]["quantaPerCell"] = toArray(structure.rounding->quantaPerCell);
    }
    report["tree"]["nodes"] = tree.nodes.size();
    report["tree"]["leaves"] = tree.leaves.size() - emptyLeaves;
    report["tree"]["emptyLeaves"] = emptyLeaves;
    report["tree"]["references"] = tree.leafTriangles.size();
    report["tree"]["depth"] = tree.depth;
    report["bytes"]["tree"] = byteSize(tree.nodes) + byteSize(tree.leaves);
    report["bytes"]["table"] = byteSize(structure.table.words);
    report["bytes"]["exitBoxes"] = byteSize(structure.table.leaves);
    report["bytes"]["referenceBoxes"] =
        byteSize(structure.table.leafRecords) - byteSize(structure.table.leaves);
    report["bytes"]["triangles"] = byteSize(structure.table.triangles);
    report["seconds"]["tree"] = structure.treeSeconds;
    report["seconds"]["table"] = structure.tableSeconds;
    report["trianglesPerSecond"] =
        seconds > 0.0 ? static_cast<double>(scene.triangles.size()) / seconds : 0.0;
    return report;
}

nlohmann::ordered_json reportRectilinear(const RectilinearTable& table) {
    const Rectilinear& layout = table.planes.layout();
    nlohmann::ordered_json report;
    report["planes"] = toArray(layout.resolution + 1u);
    report["cells"] = layout.cellCount;
    report["leaves"] = table.table.leaves.size();
    report["references"] = table.table.triangles.size();
    report["depth"] = table.depth;
    report["bytes"]["table"] = byteSize(table.table.words);
    report["bytes"]["exitBoxes"] = byteSize(table.table.leaves);
    report["bytes"]["planes"] = byteSize(table.planes.planes()) + byteSize(table.planes.buckets());
    report["bytes"]["triangles"] = byteSize(table.table.triangles);
    report["seconds"] = table.buildSeconds;
    return report;
}

} // namespace metamarch::cli
