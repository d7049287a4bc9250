// SPDX-License-Identifier: MIT
#include "metamarch/accel/rectilinear_planes.h"

#include <algorithm>
#include <bit>
#include <span>

namespace metamarch {
namespace {

// Minimum number of buckets per cell; the total is rounded up to a power of two. It doubles until no bucket
// holds two planes or kMostBuckets is reached.
constexpr std::uint32_t kBucketsPerCell = 4;
constexpr std::uint32_t kMostBuckets = 1u << 16u; // per axis; they take 256 KiB

// Returns the number of planes in the fullest bucket.
std::uint32_t mostInABucket(const std::span<const float> planes, const float bucketsPerUnit,
                            const std::uint32_t lastBucket) {
    std::uint32_t most = 0;
    std::uint32_t inThis = 0;
    std::uint32_t thisBucket = 0;
    for (const float plane : planes) {
        const std::uint32_t bucket = bucketAt(plane, bucketsPerUnit, lastBucket);
        inThis = bucket == thisBucket ? inThis + 1 : 1;
        thisBucket = bucket;
        most = std::max(most, inThis);
    }
    return most;
}

} // namespace

RectilinearPlanes::RectilinearPlanes(std::array<std::vector<float>, 3> inner, const vec3 extent) {
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        std::vector<float>& planes = inner[i];
        std::erase_if(planes, [&](const float plane) { return !(plane > 0.0f && plane < extent[axis]); });
        std::ranges::sort(planes);
        const auto repeated = std::ranges::unique(planes);
        planes.erase(repeated.begin(), repeated.end());

        shape.resolution[axis] = static_cast<std::uint32_t>(planes.size()) + 1;
        shape.firstPlane[axis] = static_cast<std::uint32_t>(allPlanes.size());
        allPlanes.push_back(0.0f);
        allPlanes.insert(allPlanes.end(), planes.begin(), planes.end());
        allPlanes.push_back(extent[axis]);
        allPlanes.push_back(kFarthest);
        addBuckets(axis, extent[axis]);
    }
    shape.cellCount = shape.resolution.x * shape.resolution.y * shape.resolution.z;
}

void RectilinearPlanes::addBuckets(const int axis, const float extent) {
    const auto planes = std::span(allPlanes).subspan(shape.firstPlane[axis] + 1, shape.resolution[axis] - 1);
    std::uint32_t count = std::bit_ceil(kBucketsPerCell * shape.resolution[axis]);
    while (count < kMostBuckets && mostInABucket(planes, static_cast<float>(count) / extent, count - 1) > 1) {
        count *= 2;
    }
    shape.bucketsPerUnit[axis] = static_cast<float>(count) / extent;
    shape.firstBucket[axis] = static_cast<std::uint32_t>(cellOfBucket.size());
    shape.lastBucket[axis] = count - 1;
    // All planes in lower buckets lie below every position in this bucket, whatever the rounding. The search
    // starts from there.
    std::uint32_t cell = 0;
    for (std::uint32_t bucket = 0; bucket < count; ++bucket) {
        while (cell < planes.size() &&
               bucketAt(planes[cell], shape.bucketsPerUnit[axis], shape.lastBucket[axis]) < bucket) {
            ++cell;
        }
        cellOfBucket.push_back(cell);
    }
}

float RectilinearPlanes::plane(const int axis, const int index) const {
    return allPlanes[shape.firstPlane[axis] + static_cast<std::uint32_t>(index)];
}

std::uint32_t RectilinearPlanes::numberOf(const int axis, const float plane) const {
    const auto first = allPlanes.begin() + shape.firstPlane[axis];
    const auto found = std::lower_bound(first, first + shape.resolution[axis], plane);
    return static_cast<std::uint32_t>(found - first);
}

ivec3 RectilinearPlanes::searchCell(const vec3 position) const {
    ivec3 cell;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t bucket =
            bucketAt(position[axis], shape.bucketsPerUnit[axis], shape.lastBucket[axis]);
        cell[axis] = static_cast<int>(cellOfBucket[shape.firstBucket[axis] + bucket]);
        while (plane(axis, cell[axis] + 1) <= position[axis]) {
            ++cell[axis];
        }
    }
    return cell;
}

std::optional<CellRange> RectilinearPlanes::touchedCells(const LatticeTriangle& triangle,
                                                         const CellRange& box,
                                                         const glm::dvec3& margin) const {
    Box grown;
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        grown.lo[axis] = static_cast<double>(plane(axis, box.lo[i])) - margin[axis];
        grown.hi[axis] = static_cast<double>(plane(axis, box.hi[i] + 1)) + margin[axis];
    }
    const std::optional<Box> part = clipTriangle(triangle, grown);
    if (!part) {
        return std::nullopt;
    }
    CellRange range;
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        // Returns the cell of a coordinate, clamped to the box.
        const auto cellOf = [&](const double coordinate) {
            const auto first = allPlanes.begin() + shape.firstPlane[axis] + box.lo[i] + 1;
            const auto behind = std::upper_bound(first, first + (box.hi[i] - box.lo[i]), coordinate);
            return static_cast<std::uint16_t>(box.lo[i] + (behind - first));
        };
        range.lo[i] = cellOf(part->lo[axis] - margin[axis]);
        range.hi[i] = cellOf(part->hi[axis] + margin[axis]);
    }
    return range;
}

} // namespace metamarch
