// SPDX-License-Identifier: MIT
// Builds a meta table over a program's own triangles and marches one ray through it on the CPU.
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/trace.h"

#include <cstdio>
#include <vector>

int main() {
    const std::vector<glm::vec3> positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {0, 2, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1},
                                               {1, 4, 2}, {2, 4, 3}, {3, 4, 0}};
    const metamarch::AccelerationStructure pyramid =
        metamarch::buildAccelerationStructure({positions, triangles}, {});

    const auto closestHit = [&](const glm::vec3 origin, const glm::vec3 direction) {
        const metamarch::Ray ray =
            metamarch::makeRay(pyramid.lattice, origin, 0.0f, direction, metamarch::kFarthest);
        const metamarch::Hit hit = metamarch::traceMetaTable(pyramid, ray, metamarch::HitQuery::closest).hit;
        if (hit.triangleId == metamarch::kNoTriangle) {
            std::puts("no hit");
        } else {
            std::printf("triangle %u at distance %.3f\n", hit.triangleId, ray.shift + hit.t);
        }
    };
    closestHit({0, 1, 5}, {0, 0, -1});
    closestHit({0.25f, -3, -0.5f}, {0, 1, 0});
    closestHit({0, 3, 5}, {0, 0, -1});
}
