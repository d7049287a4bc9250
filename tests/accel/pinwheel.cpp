// SPDX-License-Identifier: MIT
#include "accel/pinwheel.h"

#include <random>

namespace metamarch::tests {
namespace {

class Cutter {
  public:
    explicit Cutter(const std::uint32_t seed) : random(seed) {}

    void cut(const CellBox& box, const int mostCells, std::vector<CellBox>& boxes) {
        const ivec3 size = box.hi - box.lo;
        const int axis = between(0, 2);
        const bool isSolid = glm::all(glm::greaterThanEqual(size, ivec3(2)));
        const bool isFlat = size[(axis + 1) % 3] >= 3 && size[(axis + 2) % 3] >= 3;
        if (size.x * size.y * size.z <= mostCells || (!isSolid && !isFlat)) {
            boxes.push_back(box);
            return;
        }
        ivec3 middle = box.lo;
        ivec3 end = box.hi;
        for (int i = 0; i < 3; ++i) {
            if (isSolid) {
                middle[i] = between(box.lo[i] + 1, box.hi[i] - 1);
            } else if (i != axis) {
                middle[i] = between(box.lo[i] + 1, box.hi[i] - 2);
                end[i] = between(middle[i] + 1, box.hi[i] - 1);
            }
        }
        for (const CellBox& part :
             isSolid ? solidPinwheel(box, middle) : flatPinwheel(box, axis, middle, end)) {
            cut(part, mostCells, boxes);
        }
    }

  private:
    int between(const int first, const int last) {
        return std::uniform_int_distribution<int>(first, last)(random);
    }

    std::mt19937 random;
};

} // namespace

std::vector<CellBox> flatPinwheel(const CellBox& box, const int axis, const ivec3 innerLo,
                                  const ivec3 innerHi) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto part = [&](const int loU, const int hiU, const int loV, const int hiV) {
        CellBox result = box;
        result.lo[u] = loU;
        result.hi[u] = hiU;
        result.lo[v] = loV;
        result.hi[v] = hiV;
        return result;
    };
    return {
        part(box.lo[u], innerHi[u], box.lo[v], innerLo[v]),
        part(innerHi[u], box.hi[u], box.lo[v], innerHi[v]),
        part(innerLo[u], box.hi[u], innerHi[v], box.hi[v]),
        part(box.lo[u], innerLo[u], innerLo[v], box.hi[v]),
        part(innerLo[u], innerHi[u], innerLo[v], innerHi[v]),
    };
}

std::vector<CellBox> solidPinwheel(const CellBox& box, const ivec3 middle) {
    const ivec3 lo = box.lo;
    const ivec3 hi = box.hi;
    return {
        {lo, middle},
        {{lo.x, lo.y, middle.z}, {hi.x, middle.y, hi.z}},
        {{middle.x, lo.y, lo.z}, {hi.x, hi.y, middle.z}},
        {{lo.x, middle.y, lo.z}, {middle.x, hi.y, hi.z}},
        {middle, hi},
    };
}

Partition nestedPinwheels(const uvec3 resolution, const int mostCells, const std::uint32_t seed) {
    Partition partition{resolution, {}};
    Cutter(seed).cut({ivec3(0), ivec3(resolution)}, mostCells, partition.boxes);
    return partition;
}

} // namespace metamarch::tests
