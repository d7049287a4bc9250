// SPDX-License-Identifier: MIT
// Movements of the camera by the user, and the options that reproduce it.
#include "metamarch/viewer/projection.h"
#include "metamarch/viewer/view_camera.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace metamarch::viewer {
namespace {

constexpr glm::uvec2 kSize{320, 200};
constexpr float kAspect = 1.6f;
constexpr float kPixelSlack = 0.05f; // pixels

class Dice {
  public:
    float number(const float from, const float to) {
        return std::uniform_real_distribution<float>(from, to)(engine);
    }
    glm::vec3 point(const float size) {
        return {number(-size, size), number(-size, size), number(-size, size)};
    }

  private:
    std::mt19937 engine{7};
};

ViewCamera somewhere(Dice& dice) {
    ViewCamera camera;
    const float size = std::exp(dice.number(-5.0f, 5.0f));
    camera.eye = dice.point(size);
    camera.target = camera.eye + dice.point(size) + glm::vec3(0.01f * size);
    camera.verticalFov = static_cast<double>(dice.number(5.0f, 120.0f));
    return camera;
}

// Returns a scene with an upright perspective camera, one that is tilted sideways, and one with parallel
// rays.
Scene withCameras() {
    Scene scene;
    scene.cameras.push_back(lookAt({1, 2, 5}, {0, 1, 0}, {0, 1, 0}));
    scene.cameras.push_back(lookAt({3, -1, 2}, {0, 0, 0}, {0.5f, 1, 0.25f}));
    scene.cameras.push_back(lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}));
    for (SceneCamera& camera : scene.cameras) {
        camera.verticalFov = 0.7f;
    }
    scene.cameras[2].projection = SceneCamera::Projection::orthographic;
    scene.cameras[2].verticalExtent = 2.5f;
    return scene;
}

Camera traced(const ViewCamera& camera, const Scene& scene = Scene()) {
    return makeCamera(sceneCameraOf(camera, scene), kSize.x, kSize.y, lensOf(camera));
}

glm::vec2 placeOf(const ViewCamera& camera, const glm::vec3& point) {
    const auto found = project(traced(camera), point, point);
    EXPECT_TRUE(found.has_value());
    return found ? (*found)[0] : glm::vec2(-1.0f);
}

// Reads the text of the key C like the command line.
std::map<std::string, std::string> parsed(const std::string& text) {
    std::map<std::string, std::string> options;
    std::istringstream words(text);
    std::string name;
    for (std::string word; words >> word;) {
        if (word.starts_with("--")) {
            name = word;
            options[name] = "";
        } else {
            options[name] = word;
        }
    }
    return options;
}

template <class Number>
Number numberOf(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_TRUE(error == std::errc() && end == text.data() + text.size()) << text;
    return value;
}

glm::vec3 pointOf(const std::string& text) {
    glm::vec3 point{};
    std::istringstream numbers(text);
    std::string number;
    for (int axis = 0; axis < 3 && std::getline(numbers, number, ','); ++axis) {
        point[axis] = numberOf<float>(number);
    }
    return point;
}

void expectSame(const SceneCamera& a, const SceneCamera& b) {
    EXPECT_EQ(a.projection, b.projection);
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_EQ(a.forward, b.forward);
    EXPECT_EQ(a.up, b.up);
    if (a.projection == SceneCamera::Projection::orthographic) {
        EXPECT_EQ(a.verticalExtent, b.verticalExtent);
    } else {
        EXPECT_EQ(a.verticalFov, b.verticalFov);
    }
}

SceneCamera madeBy(const std::map<std::string, std::string>& options) {
    SceneCamera made =
        lookAt(pointOf(options.at("--eye")), pointOf(options.at("--target")), pointOf(options.at("--up")));
    if (options.contains("--vfov")) {
        made.verticalFov =
            static_cast<float>(numberOf<double>(options.at("--vfov")) * std::numbers::pi / 180.0);
    }
    if (options.contains("--orthographic")) {
        made.projection = SceneCamera::Projection::orthographic;
        made.verticalExtent = numberOf<float>(options.at("--orthographic"));
    }
    return made;
}

TEST(ViewCameraOptions, makeTheCameraAgainToTheBit) {
    Dice dice;
    const Scene scene;
    for (int i = 0; i < 500; ++i) {
        ViewCamera camera = somewhere(dice);
        if (i % 3 == 0) {
            camera.verticalExtent = std::exp(dice.number(-5.0f, 5.0f));
        }
        if (i % 2 == 0) {
            camera.apertureRadius = dice.number(1e-6f, 1.0f);
            camera.focusDistance = dice.number(1e-3f, 1e3f);
        }
        const auto options = parsed(optionsText(camera, scene));
        expectSame(madeBy(options), sceneCameraOf(camera, scene));
        EXPECT_EQ(options.contains("--aperture"), i % 2 == 0);
        if (i % 2 == 0) {
            EXPECT_EQ(numberOf<float>(options.at("--aperture")), lensOf(camera).apertureRadius);
            EXPECT_EQ(numberOf<float>(options.at("--focus-distance")), lensOf(camera).focusDistance);
        }
    }
}

TEST(ViewCameraOptions, nameTheFilesCameraUntilAHandMovesIt) {
    const Scene scene = withCameras();
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        ViewCamera camera = ofFile(scene, i, 3.0f);
        EXPECT_EQ(optionsText(camera, scene), "--camera " + std::to_string(i));
        expectSame(sceneCameraOf(camera, scene), scene.cameras[i]);
        orbit(camera, 0.1f, 0.2f);
        EXPECT_FALSE(camera.fileCamera);
        expectSame(madeBy(parsed(optionsText(camera, scene))), sceneCameraOf(camera, scene));
    }
}

TEST(ViewCameraOptions, sayAFieldOfViewThatIsNotTheFiles) {
    const Scene scene = withCameras();
    ViewCamera camera = ofFile(scene, 0, 3.0f);
    camera.verticalFov = 20.0;
    EXPECT_EQ(optionsText(camera, scene), "--camera 0 --vfov 20");
    EXPECT_EQ(sceneCameraOf(camera, scene).verticalFov, static_cast<float>(20.0 * std::numbers::pi / 180.0));
}

TEST(ViewCameraOptions, ofAPanoramaHaveNeitherLensNorFieldOfView) {
    ViewCamera camera;
    camera.isPanorama = true;
    camera.apertureRadius = 0.5f;
    EXPECT_EQ(optionsText(camera, Scene()), "--eye 0,0,1 --target 0,0,0 --up 0,1,0 --panorama");
    EXPECT_EQ(lensOf(camera).apertureRadius, 0.0f);
}

// A model beside the panel stays there.
TEST(ViewCameraOrbit, turnsAroundAPointBesideTheTarget) {
    ViewCamera camera; // looks along -z at the origin
    camera.verticalFov = 90.0;
    camera.aside = 0.25f; // of a height of 2
    orbit(camera, static_cast<float>(std::numbers::pi), 0.0f);
    const auto expectNear = [](const glm::vec3& a, const glm::vec3& b) {
        EXPECT_LT(glm::distance(a, b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
    };
    expectNear(camera.target, {1.0f, 0.0f, 0.0f});
    expectNear(camera.eye, {1.0f, 0.0f, -1.0f});
    EXPECT_EQ(camera.aside, 0.25f);
}

TEST(ViewCameraOrbit, keepsTheDistanceAndCrossesNoPole) {
    Dice dice;
    for (int i = 0; i < 20; ++i) {
        ViewCamera camera = somewhere(dice);
        camera.up = glm::normalize(dice.point(1.0f) + glm::vec3(0, 1.5f, 0));
        const glm::vec3 target = camera.target;
        const float distance = glm::length(camera.eye - target);
        for (int step = 0; step < 500; ++step) {
            const float down = step % 100 < 50 ? 0.2f : -0.3f; // goes up to the poles and tries to pass them
            const glm::vec3 before = axesOf(camera).right;
            orbit(camera, step % 7 == 0 ? 0.4f : 0.0f, down);
            ASSERT_EQ(camera.target, target);
            // Each step rounds the coordinates, so the distance drifts a little.
            ASSERT_NEAR(glm::length(camera.eye - target), distance, 1e-3f * distance);
            const glm::vec3 right = axesOf(camera).right;
            ASSERT_GT(glm::dot(right, before), 0.5f) << "turned round at step " << step;
        }
    }
}

TEST(ViewCameraLook, turnsTheHeadInPlace) {
    ViewCamera camera;
    look(camera, 0.1f, 0.05f); // to the right and down
    EXPECT_EQ(camera.eye, ViewCamera().eye);
    EXPECT_GT(camera.target.x, 0.05f);
    EXPECT_LT(camera.target.y, -0.02f);
}

TEST(ViewCameraFly, goesAlongItsOwnAxes) {
    ViewCamera camera;
    fly(camera, 1.0f, 2.0f, 3.0f);
    EXPECT_EQ(camera.eye, glm::vec3(1, 2, -2));
    EXPECT_EQ(camera.target, glm::vec3(1, 2, -3));
}

TEST(ViewCameraZoom, keepsThePointUnderTheCursorInPlace) {
    Dice dice;
    for (int i = 0; i < 200; ++i) {
        ViewCamera camera = somewhere(dice);
        if (i % 2 == 0) {
            camera.verticalExtent = glm::length(camera.target - camera.eye);
        }
        const glm::vec2 cursor(dice.number(0.0f, kSize.x), dice.number(0.0f, kSize.y));
        const CameraRay ray = cameraRayThrough(traced(camera), cursor, glm::vec2(0.0f));
        const glm::vec3 point =
            ray.origin + ray.dir * glm::length(camera.target - camera.eye) * dice.number(0.5f, 2.0f);
        for (const float factor : {0.87f, 0.5f, 1.5f}) {
            const float distance = glm::length(camera.eye - point);
            zoom(camera, factor, point);
            EXPECT_NEAR(glm::length(camera.eye - point), factor * distance, 1e-4f * distance);
            EXPECT_LT(glm::distance(placeOf(camera, point), cursor), kPixelSlack);
        }
    }
}

TEST(ViewCameraZoom, endsBeforeEyeAndTargetAreOnePoint) {
    ViewCamera camera;
    camera.eye = {100.0f, 50.0f, 30.0f};
    camera.target = {100.0f, 50.0f, 0.0f};
    for (int i = 0; i < 1000; ++i) {
        zoom(camera, 0.87f, camera.target);
    }
    EXPECT_NO_THROW(lookAt(camera.eye, camera.target, camera.up));
    const float closest = glm::length(camera.eye - camera.target);
    zoom(camera, 2.0f, camera.target);
    EXPECT_GT(glm::length(camera.eye - camera.target), 1.5f * closest);
}

TEST(ViewCameraPan, movesTheTargetAsTheCursor) {
    Dice dice;
    for (int i = 0; i < 200; ++i) {
        ViewCamera camera = somewhere(dice);
        if (i % 2 == 0) {
            camera.verticalExtent = glm::length(camera.target - camera.eye);
        }
        const glm::vec3 held = camera.target;
        const glm::vec2 moved(dice.number(-50.0f, 50.0f), dice.number(-50.0f, 50.0f));
        pan(camera, -moved.x / static_cast<float>(kSize.y), moved.y / static_cast<float>(kSize.y));
        EXPECT_LT(glm::distance(placeOf(camera, held), glm::vec2(kSize) * 0.5f + moved), kPixelSlack);
    }
}

void expectInside(const ViewCamera& camera, const Bounds& bounds, const glm::uvec2 size) {
    const Camera picture = makeCamera(sceneCameraOf(camera, Scene()), size.x, size.y);
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 corner(i & 1u ? bounds.hi.x : bounds.lo.x, i & 2u ? bounds.hi.y : bounds.lo.y,
                               i & 4u ? bounds.hi.z : bounds.lo.z);
        const auto place = project(picture, corner, corner);
        ASSERT_TRUE(place.has_value());
        EXPECT_GE((*place)[0].x, -kPixelSlack);
        EXPECT_GE((*place)[0].y, -kPixelSlack);
        EXPECT_LE((*place)[0].x, static_cast<float>(size.x) + kPixelSlack);
        EXPECT_LE((*place)[0].y, static_cast<float>(size.y) + kPixelSlack);
    }
}

TEST(ViewCameraFraming, containsAllCorners) {
    Dice dice;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 corner = dice.point(10.0f);
        const Bounds bounds{corner, corner + glm::abs(dice.point(5.0f))};
        for (const glm::uvec2 size : {glm::uvec2(320, 200), glm::uvec2(100, 400)}) {
            const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
            expectInside(framing(bounds, aspect, 45.0), bounds, size);
            ViewCamera from = somewhere(dice);
            expectInside(framing(bounds, aspect, from), bounds, size);
            from.verticalExtent = 1.0f;
            expectInside(framing(bounds, aspect, from), bounds, size);
        }
    }
}

TEST(ViewCameraFraming, ofNothingAndOfOnePointIsACamera) {
    for (const Bounds& bounds : {boundsOf(Scene()), Bounds{glm::vec3(2.0f), glm::vec3(2.0f)}}) {
        for (const bool isParallel : {false, true}) {
            ViewCamera from;
            if (isParallel) {
                from.verticalExtent = 3.0f;
            }
            EXPECT_NO_THROW(traced(framing(bounds, kAspect, from)));
            EXPECT_NO_THROW(traced(framing(bounds, kAspect, 45.0)));
            EXPECT_GT(framing(bounds, kAspect, from).verticalExtent.value_or(1.0f), 0.0f);
        }
    }
}

TEST(ViewCameraFraming, keepsTheDirection) {
    Dice dice;
    const ViewCamera from = somewhere(dice);
    const ViewCamera framed = framing({glm::vec3(-1.0f), glm::vec3(1.0f)}, kAspect, from);
    EXPECT_LT(glm::distance(axesOf(framed).forward, axesOf(from).forward), 1e-5f);
}

TEST(ViewCameraOfFile, keepsItsUpWhereItLeans) {
    const Scene scene = withCameras();
    ViewCamera upright = ofFile(scene, 0, 3.0f);
    fly(upright, 0.0f, 0.0f, 0.1f);
    EXPECT_EQ(upright.up, glm::vec3(0, 1, 0));
    ViewCamera leaning = ofFile(scene, 1, 3.0f);
    fly(leaning, 0.0f, 0.0f, 0.1f);
    EXPECT_LT(glm::distance(leaning.up, scene.cameras[1].up), 1e-6f);
    // The picture does not turn when the user moves the camera for the first time.
    EXPECT_LT(glm::distance(sceneCameraOf(leaning, scene).up, scene.cameras[1].up), 1e-6f);
}

TEST(ViewCameraOfFile, isFollowedWhenTheFileIsReadAgain) {
    const Scene before = withCameras();
    Scene now = before;
    now.cameras[0] = lookAt({7, 8, 9}, {0, 0, 0}, {0, 1, 0});
    now.cameras[0].verticalFov = 0.9f;
    ViewCamera camera = ofFile(before, 0, 3.0f);
    camera.apertureRadius = 0.25f;
    const ViewCamera moved = followed(camera, before, now, 3.0f);
    expectSame(sceneCameraOf(moved, now), now.cameras[0]);
    EXPECT_EQ(moved.eye, now.cameras[0].eye);
    EXPECT_EQ(moved.apertureRadius, 0.25f);
    camera.verticalFov = 20.0;
    EXPECT_EQ(followed(camera, before, now, 3.0f).verticalFov, 20.0);
}

TEST(ViewCameraOfFile, staysWhereItWasWhenItIsGone) {
    const Scene before = withCameras();
    Scene now = before;
    now.cameras.resize(1);
    const ViewCamera left = followed(ofFile(before, 2, 3.0f), before, now, 3.0f);
    EXPECT_FALSE(left.fileCamera);
    expectSame(sceneCameraOf(left, now), before.cameras[2]);
}

} // namespace
} // namespace metamarch::viewer
