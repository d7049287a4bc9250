// SPDX-License-Identifier: MIT
#include "metamarch/viewer/solid_box.h"

#include "metamarch/viewer/pick.h"
#include "metamarch/viewer/projection.h"

#include <optional>

namespace metamarch::viewer {
namespace {

constexpr std::size_t kPiecesPerEdge = 20; // of a face: some 1,300 rays for three faces, a few milliseconds
// A surface that lies in a face hides nothing: distances that differ by less than this part are the same.
constexpr float kSame = 1e-3f;

std::optional<SolidPoint> seenPoint(const LoadedScene& scene, const Camera& camera, const glm::vec3& point) {
    const auto place = project(camera, point, point);
    if (!place) {
        return std::nullopt;
    }
    const CameraRay view = cameraRayThrough(camera, (*place)[0], vec2(0.0f));
    const float distance = glm::dot(point - view.origin, view.dir);
    const Ray ray = rayThrough(scene, camera, (*place)[0]);
    const TraceResult found = traceKdStack(*scene.shown.structure, ray, HitQuery::closest);
    const bool isSeen =
        found.hit.triangleId == kNoTriangle || ray.shift + found.hit.t >= distance * (1.0f - kSame);
    return SolidPoint{(*place)[0], isSeen};
}

// A face: its corner with the least coordinates, its sides, and its normal out of the box.
struct Face {
    glm::vec3 corner;
    glm::vec3 along;
    glm::vec3 across;
    glm::vec3 normal;
};

Face faceOf(const Bounds& box, const int axis, const bool isUpper) {
    const glm::vec3 size = box.hi - box.lo;
    Face face{box.lo, glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)};
    face.along[(axis + 1) % 3] = size[(axis + 1) % 3];
    face.across[(axis + 2) % 3] = size[(axis + 2) % 3];
    face.corner[axis] = isUpper ? box.hi[axis] : box.lo[axis];
    face.normal[axis] = isUpper ? 1.0f : -1.0f;
    return face;
}

void addFace(const LoadedScene& scene, const Camera& camera, const Face& face, const float light,
             std::vector<SolidPart>& parts) {
    std::array<std::array<std::optional<SolidPoint>, kPiecesPerEdge + 1>, kPiecesPerEdge + 1> points;
    for (std::size_t i = 0; i <= kPiecesPerEdge; ++i) {
        for (std::size_t j = 0; j <= kPiecesPerEdge; ++j) {
            const glm::vec2 at = glm::vec2(i, j) / static_cast<float>(kPiecesPerEdge);
            points[i][j] = seenPoint(scene, camera, face.corner + face.along * at.x + face.across * at.y);
        }
    }
    for (std::size_t i = 0; i < kPiecesPerEdge; ++i) {
        for (std::size_t j = 0; j < kPiecesPerEdge; ++j) {
            const auto& a = points[i][j];
            const auto& b = points[i + 1][j];
            const auto& c = points[i + 1][j + 1];
            const auto& d = points[i][j + 1];
            if (a && b && c && d && (a->isSeen || b->isSeen || c->isSeen || d->isSeen)) {
                parts.push_back({{*a, *b, *c, *d}, light});
            }
        }
    }
}

void addEdges(const LoadedScene& scene, const Camera& camera, const Bounds& box,
              std::vector<SolidEdge>& edges) {
    for (int axis = 0; axis < 3; ++axis) {
        for (unsigned side = 0; side < 4; ++side) {
            glm::vec3 from = box.lo;
            from[(axis + 1) % 3] = (side & 1u) ? box.hi[(axis + 1) % 3] : box.lo[(axis + 1) % 3];
            from[(axis + 2) % 3] = (side & 2u) ? box.hi[(axis + 2) % 3] : box.lo[(axis + 2) % 3];
            std::optional<SolidPoint> before = seenPoint(scene, camera, from);
            for (std::size_t i = 1; i <= kPiecesPerEdge; ++i) {
                glm::vec3 to = from;
                to[axis] = glm::mix(box.lo[axis], box.hi[axis],
                                    static_cast<float>(i) / static_cast<float>(kPiecesPerEdge));
                const std::optional<SolidPoint> next = seenPoint(scene, camera, to);
                if (before && next) {
                    edges.push_back({{before->place, next->place}, before->isSeen && next->isSeen});
                }
                before = next;
            }
        }
    }
}

} // namespace

SolidBox solidBox(const LoadedScene& scene, const Camera& camera, const Bounds& box) {
    SolidBox solid;
    addEdges(scene, camera, box, solid.edges);
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool isUpper : {false, true}) {
            const Face face = faceOf(box, axis, isUpper);
            const auto middle = project(camera, face.corner + 0.5f * (face.along + face.across),
                                        face.corner + 0.5f * (face.along + face.across));
            if (!middle) {
                continue;
            }
            const CameraRay view = cameraRayThrough(camera, (*middle)[0], vec2(0.0f));
            const float cosine = -glm::dot(view.dir, face.normal);
            if (glm::dot(face.corner - view.origin, face.normal) < 0.0f) {
                addFace(scene, camera, face, 0.45f + 0.55f * glm::abs(cosine), solid.parts);
            }
        }
    }
    return solid;
}

} // namespace metamarch::viewer
