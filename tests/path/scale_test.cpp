// SPDX-License-Identifier: MIT
// In large scenes, in small ones and far from the origin, no surface shadows itself and no wall leaks light.
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

namespace metamarch::tests {
namespace {

// A scene is scaled and then moved by `offset` along all axes.
struct Place {
    float scale;
    float offset;
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const Place& place, std::ostream* out) {
    *out << "scaled by " << place.scale << ", moved by " << place.offset;
}

glm::vec3 placed(const glm::vec3 point, const Place& place) {
    return point * place.scale + glm::vec3(place.offset);
}

// Returns an ulp of the scene's coordinates, divided by the scaled unit length.
double ulpOf(const Place& place) { return std::max(place.offset, place.scale) * 0x1p-23 / place.scale; }

class PathScale : public testing::TestWithParam<Place> {
  protected:
    // Moves a scene from the origin to the place. The irradiance of point lights does not change.
    PathScene moved(PathScene made) const {
        for (glm::vec3& position : made.scene.positions) {
            position = placed(position, place);
        }
        for (PunctualLight& light : made.scene.lights) {
            light.position = placed(light.position, place);
            light.intensity *= place.scale * place.scale;
        }
        made.view.eye = placed(made.view.eye, place);
        made.view.verticalExtent *= place.scale;
        return made;
    }

    const Place place = GetParam();
};

PathScene ballUnderSky(const float albedo) {
    PathScene made;
    addBall(made.scene, glm::vec3(0.0f), 10.0f, addMaterial(made.scene, lambert(glm::vec3(albedo))));
    made.surroundings.background = glm::vec3(1.0f);
    made.view = lookAt({3.0f, 5.0f, 40.0f}, glm::vec3(0.0f), {0, 1, 0});
    made.view.verticalFov = 0.5f;
    return made;
}

TEST_P(PathScale, whiteBallStaysInvisible) {
    const auto film = render(moved(ballUnderSky(1.0f)), {.samples = 32, .maxBounces = 64, .side = 24});
    EXPECT_NEAR(coveredMeanOf(film).r, 1.0, 1e-5);
}

// The octahedron is convex and exactly representable at every place, so no ray that leaves it hits it again.
TEST_P(PathScale, greyOctahedronStaysConvex) {
    PathScene made;
    const std::uint32_t grey = addMaterial(made.scene, lambert(glm::vec3(0.5f)));
    for (unsigned i = 0; i < 8; ++i) {
        const float x = i & 1u ? 8.0f : -8.0f;
        const float y = i & 2u ? 8.0f : -8.0f;
        const float z = i & 4u ? 8.0f : -8.0f;
        addFacet(made.scene, {x, 0, 0}, {0, y, 0}, {0, 0, z}, glm::vec3(0.0f), grey);
    }
    made.surroundings.background = glm::vec3(1.0f);
    made.view = lookAt({3.0f, 5.0f, 40.0f}, glm::vec3(0.0f), {0, 1, 0});
    made.view.verticalFov = 0.4f;
    std::size_t covered = 0;
    for (const FilmPixel& pixel : render(moved(made), {.samples = 64, .side = 32})) {
        if (pixel.covered == static_cast<float>(pixel.samples)) {
            ASSERT_NEAR(meanOf(pixel).r, 0.5, 1e-5);
            ++covered;
        }
    }
    EXPECT_GT(covered, 300u);
}

// A tilted floor is under a point light, which is high or grazing. Shadow rays that hit their own floor would
// leave dark pixels.
TEST_P(PathScale, floorHasNoAcne) {
    const glm::dvec3 right(6.0, 3.0, 2.0); // `right` and `up` span a square with sides of length 7
    const glm::dvec3 up(-2.0, 6.0, -3.0);
    const glm::dvec3 normal = glm::cross(right, up) / 49.0;
    for (const double height : {4.0, 0.25}) {
        PathScene made;
        addQuad(made.scene, glm::vec3(-2.0 * (right + up)), glm::vec3(4.0 * right), glm::vec3(4.0 * up),
                addMaterial(made.scene, lambert(glm::vec3(1.0f))));
        const glm::vec3 lightAt(height * normal);
        addPointLight(made.scene, lightAt, std::numbers::pi_v<float>);
        made.view = lookAt(glm::vec3(20.0 * normal), glm::vec3(0.0f), {0, 0, 1});
        made.view.projection = SceneCamera::Projection::orthographic;
        made.view.verticalExtent = 10.0f;
        constexpr double kSide = 32.0;
        const auto film = render(moved(made), {.samples = 16, .side = 32});
        for (std::size_t i = 0; i < film.size(); ++i) {
            // The darkest point of a pixel is its corner that is farthest from the light.
            const double x = (static_cast<double>(i % 32) + 0.5) / kSide - 0.5;
            const std::size_t row = i / 32;
            const double y = 0.5 - (static_cast<double>(row) + 0.5) / kSide;
            const double reach = 10.0 * (std::hypot(x, y) + std::numbers::sqrt2 / 2.0 / kSide);
            const double darkest = height / std::pow(height * height + reach * reach, 1.5);
            // Heights over the floor have an error of a few ulps of the coordinates.
            const double known = 1.0 - 1e-3 - 8.0 * ulpOf(place) / height;
            ASSERT_GE(meanOf(film[i]).r, darkest * known) << "pixel " << i << ", light at " << height;
        }
    }
}

// A lamp is in a closed box, which is seen from outside, along edges and corners.
TEST_P(PathScale, closedBoxStaysBlack) {
    PathScene made;
    addBox(made.scene, {-8, -8, -8}, {8, 8, 8}, addMaterial(made.scene, lambert(glm::vec3(1.0f))));
    addBall(made.scene, {0, 0, 0}, 6.0f, addMaterial(made.scene, emitter(glm::vec3(1e6f))), false, 16);
    addPointLight(made.scene, {7, 7, 7}, 1e6f);
    for (const glm::vec3 eye : {glm::vec3(30, 20, 40), glm::vec3(8, 8, 40), glm::vec3(20, 0, 0)}) {
        made.view = lookAt(eye, {0.5f, 0.3f, 0}, {0, 1, 0});
        made.view.verticalFov = 0.7f;
        for (const FilmPixel& pixel : render(moved(made), {.samples = 16, .side = 32})) {
            ASSERT_EQ(pixel.radiance, glm::vec3(0.0f)) << eye.x;
        }
    }
}

// A closed white room without light is in a bright environment. It is seen from inside, with 16 bounces.
TEST_P(PathScale, closedRoomStaysBlack) {
    PathScene made;
    addBox(made.scene, {-8, -16, -8}, {8, 8, 16}, addMaterial(made.scene, lambert(glm::vec3(1.0f))),
           Facing::inwards);
    made.surroundings.background = glm::vec3(1.0f);
    made.view = lookAt({2, 3, 4}, {-8, -8, 0}, {0, 1, 0});
    made.view.verticalFov = 1.5f;
    const double leak = meanOf(render(moved(made), {.samples = 64, .maxBounces = 16, .side = 32})).r;
    // A hit within half an ulp of the next wall is rounded to that wall, and the path may continue behind it.
    // `chance` is the probability of that for 16 bounces at 4 edges, with walls that are at least 16 long. At
    // most a sixth of it was measured.
    const double chance = 16.0 * 4.0 * ulpOf(place) / 16.0;
    EXPECT_LE(leak, place.offset == 0.0f ? 0.0 : 0.25 * chance);
}

INSTANTIATE_TEST_SUITE_P(Places, PathScale,
                         testing::Values(Place{1.0f, 0.0f}, Place{1e-3f, 0.0f}, Place{1e4f, 0.0f},
                                         Place{1.0f, 1e5f}, Place{1e4f, 1e5f}, Place{1e-3f, 1.0f}),
                         [](const auto& instance) { return "Place" + std::to_string(instance.index); });

} // namespace
} // namespace metamarch::tests
