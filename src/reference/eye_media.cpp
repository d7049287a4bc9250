// SPDX-License-Identifier: MIT
#include "metamarch/reference/eye_media.h"

#include "metamarch/reference/trace.h"
#include "metamarch/shared/hit_point.h"
#include "metamarch/shared/scene_layout.h"
#include "metamarch/shared/surface.h"

#include <vector>

namespace metamarch {
namespace {

// Not along an axis or a diagonal: models have their edges there.
const glm::vec3 kOutwards = glm::normalize(glm::vec3(0.31f, 0.87f, 0.43f));

} // namespace

Media mediaAt(const AccelerationStructure& structure, const ShadingScene& scene, const glm::vec3 point) {
    Media around = noMedia();
    if (!hasFeature(scene, kFeatureVolume)) {
        return around;
    }
    std::vector<std::uint32_t> entered(scene.materials.size()); // how many volumes of each material
    Ray ray = makeRay(structure.lattice, point, 0.0f, kOutwards, kFarthest);
    while (true) {
        const TraceResult found = traceKdStack(structure, ray, HitQuery::closest);
        if (found.hit.triangleId == kNoTriangle) {
            return around;
        }
        const TriangleRecord& triangle = structure.triangles[found.recordIndex];
        const std::uint32_t material = scene.surfaces[found.hit.triangleId].material;
        if ((scene.materials[material].flags & kSurfaceVolume) != 0u) {
            const bool isBack =
                glm::dot(scaledNormal(triangle.v0, triangle.v1, triangle.v2), kOutwards) > 0.0f;
            if (!isBack) {
                ++entered[material];
            } else if (entered[material] > 0) {
                --entered[material];
            } else {
                around = enclosedBy(around, mediumOf(material));
            }
        }
        ray = rayBehind(ray, found.hit.t);
    }
}

} // namespace metamarch
