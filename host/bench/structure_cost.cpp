#include "metamarch/bench/structure_cost.h"

#include "metamarch/bench/row.h"

#include <chrono>

namespace metamarch::bench {
namespace {

template <class T>
std::uint64_t byteSize(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

// What `get` returns, and the seconds that building it took where this is the first time.
template <class Get>
auto timed(const Get& get, double& seconds) {
    const auto start = std::chrono::steady_clock::now();
    const auto* const value = &get();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return value;
}

} // namespace

std::optional<StructureCost> StructureCosts::of(const std::string_view traversal) {
    const auto found = known.find(traversal);
    return found != known.end() ? found->second : known.emplace(traversal, measure(traversal)).first->second;
}

std::optional<StructureCost> StructureCosts::measure(const std::string_view traversal) const {
    const AccelerationStructure& base = set.kdTree();
    const std::uint64_t leafBytes = byteSize(base.tree.leaves) + byteSize(base.triangles);
    const std::uint64_t treeBytes = byteSize(base.tree.nodes) + leafBytes;
    if (traversal == "meta_table") {
        // An entry of a brick and one of a cell: few whole bricks lie near surfaces.
        return StructureCost{2 * sizeof(std::uint32_t) + sizeof(Leaf),
                             byteSize(base.table.words) + byteSize(base.table.leaves) +
                                 base.tableTriangles().size_bytes(),
                             base.treeSeconds + base.tableSeconds};
    }
    if (traversal == "kd_backtrack") {
        double seconds = base.treeSeconds;
        const auto* const parents = timed([&]() -> auto& { return set.kdParents(); }, seconds);
        return StructureCost{sizeof(KdNode), treeBytes + byteSize(*parents), seconds};
    }
    if (traversal == "kd_ropes") {
        double seconds = base.treeSeconds;
        const auto* const ropes = timed([&]() -> auto& { return set.kdRopes(); }, seconds);
        return StructureCost{sizeof(KdNode), treeBytes + byteSize(*ropes), seconds};
    }
    if (traversal.starts_with("kd_")) {
        return StructureCost{sizeof(KdNode), treeBytes, base.treeSeconds};
    }
    double seconds = 0.0;
    const std::uint64_t recordBytes = byteSize(set.triangles());
    if (traversal == "bvh_stack") {
        const Bvh* const bvh = timed([&]() -> auto& { return set.bvh(); }, seconds);
        return StructureCost{sizeof(BvhNode), byteSize(bvh->nodes) + byteSize(bvh->triangles), seconds};
    }
    if (traversal == "uniform_grid") {
        const UniformGrid* const grid = timed([&]() -> auto& { return set.uniformGrid(); }, seconds);
        return StructureCost{sizeof(GridCell), byteSize(grid->cells) + byteSize(grid->triangles), seconds};
    }
    if (traversal == "rectilinear_table") {
        const RectilinearTable& built = set.rectilinearTable();
        const MetaTable& table = built.table;
        // Three planes for the exit and, behind it, three look-ups with one plane each.
        return StructureCost{2 * sizeof(std::uint32_t) + sizeof(Leaf) + 3 * sizeof(float) +
                                 3 * (sizeof(std::uint32_t) + sizeof(float)),
                             byteSize(table.words) + byteSize(table.leaves) + byteSize(table.triangles) +
                                 byteSize(built.planes.planes()) + byteSize(built.planes.buckets()),
                             built.buildSeconds};
    }
    if (traversal == kFloor) {
        return StructureCost{0, byteSize(base.triangles), 0.0};
    }
    if (traversal == "brute_force") {
        return StructureCost{0, recordBytes, 0.0};
    }
    return std::nullopt;
}

double fetchedBytes(const StructureCost& cost, const double visitsPerRay, const double testsPerRay) {
    return visitsPerRay * static_cast<double>(cost.bytesPerVisit) +
           testsPerRay * static_cast<double>(sizeof(TriangleRecord));
}

} // namespace metamarch::bench
