// SPDX-License-Identifier: MIT
#include "metamarch/viewer/projection.h"

#include <utility>

namespace metamarch::viewer {
namespace {

// The least depth that is projected, as a fraction of the segment's distance and length; nearer to the eye,
// rounding errors would dominate the quotient.
constexpr float kNearest = 1e-4f;

struct InView {
    glm::vec2 place; // from the picture's middle, in halves of its size, times `depth`
    float depth;     // along the view axis; 1 for parallel rays
};

} // namespace

std::optional<std::array<glm::vec2, 2>> project(const Camera& camera, const glm::vec3& from,
                                                const glm::vec3& to) {
    if (camera.projection == kProjectionPanorama) {
        return std::nullopt;
    }
    const bool isParallel = camera.dirRight == glm::vec3(0.0f);
    const glm::vec3 right = isParallel ? camera.eyeRight : camera.dirRight;
    const glm::vec3 down = isParallel ? camera.eyeDown : camera.dirDown;
    const auto look = [&](const glm::vec3& point) -> InView {
        const glm::vec3 offset = point - camera.eye;
        return {
            {glm::dot(offset, right) / glm::dot(right, right), glm::dot(offset, down) / glm::dot(down, down)},
            isParallel ? 1.0f : glm::dot(offset, camera.forward)};
    };
    InView a = look(from);
    InView b = look(to);
    const float nearest =
        isParallel ? 0.0f : kNearest * (glm::length(from - camera.eye) + glm::length(to - from));
    if (a.depth <= nearest && b.depth <= nearest) {
        return std::nullopt;
    }
    const auto cut = [&](InView& behind, const InView& before) {
        if (behind.depth < nearest) {
            const float part = (nearest - behind.depth) / (before.depth - behind.depth);
            behind = {glm::mix(behind.place, before.place, part), nearest};
        }
    };
    cut(a, b);
    cut(b, a);
    const glm::vec2 size(camera.width, camera.height);
    const auto toPixels = [&](const InView& view) { return (view.place / view.depth + 1.0f) * 0.5f * size; };
    return std::array{toPixels(a), toPixels(b)};
}

} // namespace metamarch::viewer
