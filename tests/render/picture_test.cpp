// SPDX-License-Identifier: MIT
// renderPicture on the device and on the CPU: progress, cancelling, the result's members and its file.
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/picture.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

namespace metamarch::tests {
namespace {

using render::RenderResult;
using render::RenderSettings;

enum class Backend { cpu, device };

std::string nameOfBackend(const Backend backend) { return backend == Backend::cpu ? "cpu" : "device"; }

// A ball over a floor. The size of the picture is not a multiple of a tile's.
class Picture : public testing::TestWithParam<Backend> {
  protected:
    Picture()
        : prepared(ballOnFloor(), {}),
          view(frameBounds(boundsOf(*prepared.scene), kDefaultVerticalFov, 51.0f / 38.0f)),
          camera(makeCamera(view, 51, 38)) {}

    static std::shared_ptr<const Scene> ballOnFloor() {
        auto scene = std::make_shared<Scene>();
        addPlane(*scene, 0.0f, 2.0f);
        addSphere(*scene, {0.0f, 0.6f, 0.0f}, 0.5f, 16, 8);
        scene->lights.push_back({.name = "lamp", .intensity = 20.0f, .position = {1.0f, 3.0f, 1.0f}});
        return scene;
    }

    void lightFor(const RenderSettings& settings) { prepared.light("ball", settings.path, {}); }

    RenderResult render(const RenderSettings& settings, const OnProgress& onProgress = {}) {
        if (!settings.isPrimary()) {
            lightFor(settings);
        }
        return GetParam() == Backend::cpu ? renderPicture(prepared, camera, settings, onProgress)
                                          : renderPicture(render::DeviceScene(vulkan::testDevice(), prepared),
                                                          camera, settings, onProgress);
    }

    static RenderSettings by(const Integrator integrator, const std::uint32_t samples = 1) {
        RenderSettings settings;
        settings.path.integrator = integrator;
        settings.samplesPerPixel = samples;
        settings.traversal = traversals().front();
        return settings;
    }

    render::PreparedScene prepared;
    SceneCamera view;
    Camera camera;
};

bool isSame(const FilmPixel& a, const FilmPixel& b) { return std::memcmp(&a, &b, sizeof(FilmPixel)) == 0; }

// Expects that every pixel is whole or empty, and returns the number of whole ones.
std::size_t countWhole(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& whole) {
    EXPECT_EQ(film.size(), whole.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const bool isEmpty = isSame(film[i], emptyPixel());
        EXPECT_TRUE(isEmpty || isSame(film[i], whole[i])) << i;
        count += isEmpty ? 0 : 1;
    }
    return count;
}

TEST_P(Picture, progressRisesToOne) {
    for (const Integrator integrator : {Integrator::path, Integrator::primary}) {
        SCOPED_TRACE(nameOf(integrator));
        std::vector<double> parts;
        const RenderResult result = render(by(integrator, 3), [&](const double part) {
            parts.push_back(part);
            return true;
        });
        EXPECT_FALSE(result.isCancelled);
        ASSERT_GT(parts.size(), 1u);
        EXPECT_GT(parts.front(), 0.0);
        EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
        EXPECT_EQ(parts.back(), 1.0);
    }
}

TEST_P(Picture, holdsWhatIsThereWhenItIsCancelled) {
    for (const Integrator integrator : {Integrator::path, Integrator::primary}) {
        SCOPED_TRACE(nameOf(integrator));
        const RenderResult result = render(by(integrator), [](double) { return false; });
        EXPECT_TRUE(result.isCancelled);
        const std::size_t pixels = countWhole(result.film.pixels, render(by(integrator)).film.pixels);
        EXPECT_GT(pixels, 0u);
        EXPECT_LT(pixels, result.film.pixels.size());
    }
}

TEST_P(Picture, isNotCancelledAtItsEnd) {
    const RenderResult result = render(by(Integrator::path), [](const double part) { return part < 1.0; });
    EXPECT_FALSE(result.isCancelled);
    EXPECT_EQ(countWhole(result.film.pixels, render(by(Integrator::path)).film.pixels),
              result.film.pixels.size());
}

TEST_P(Picture, saysWhatItTook) {
    const RenderResult result = render(by(Integrator::path, 2));
    const bool isOnDevice = GetParam() == Backend::device;
    EXPECT_EQ(result.device, isOnDevice ? vulkan::testDevice().name() : "cpu");
    EXPECT_EQ(result.traversal, isOnDevice ? traversals().front() : "kd_stack");
    EXPECT_EQ(result.size, glm::uvec2(51, 38));
    EXPECT_GE(result.counts.rays, 2.0 * 51 * 38);
    EXPECT_GT(result.counts.shadowRays, 0.0);
    EXPECT_GT(result.seconds.render, 0.0);
    EXPECT_EQ(result.submissions > 0, isOnDevice);
    EXPECT_EQ(result.seconds.device > 0.0, isOnDevice);
    EXPECT_TRUE(result.warnings.empty());

    const RenderResult primary = render(by(Integrator::primary));
    EXPECT_EQ(primary.counts.rays, 51.0 * 38);
    EXPECT_GT(primary.counts.hits, 0u);
    EXPECT_LT(primary.counts.hits, 51u * 38u);
}

TEST_P(Picture, isRefusedWithoutTheLightOfItsIntegrator) {
    const auto attempt = [&](const RenderSettings& settings) {
        if (GetParam() == Backend::cpu) {
            renderPicture(prepared, camera, settings);
        } else {
            renderPicture(render::DeviceScene(vulkan::testDevice(), prepared), camera, settings);
        }
    };
    EXPECT_THROW(attempt(by(Integrator::path)), std::invalid_argument);
    lightFor(by(Integrator::path));
    EXPECT_THROW(attempt(by(Integrator::ao)), std::invalid_argument);
    EXPECT_NO_THROW(attempt(by(Integrator::direct)));
}

TEST_P(Picture, writesHowItWasMade) {
    const TemporaryFolder folder;
    RenderSettings settings = by(Integrator::direct, 2);
    settings.path.seed = 5;
    const RenderResult result = render(settings);
    render::writePicture(result, {"metamarch 0", "ball.glb", view, "--spp 2"}, folder / "a.exr");
    render::writePicture(result, {"metamarch 0", "ball.glb", view}, folder / "a.PNG");
    const Image exr = readImage(folder / "a.exr");
    std::map<std::string, std::string> header(exr.attributes.begin(), exr.attributes.end());
    EXPECT_EQ(header["Software"], "metamarch 0");
    EXPECT_EQ(header["metamarch/scene"], "ball.glb");
    EXPECT_EQ(header["metamarch/device"], result.device);
    EXPECT_EQ(header["metamarch/traversal"], result.traversal);
    EXPECT_EQ(header["metamarch/integrator"], "direct");
    EXPECT_EQ(header["metamarch/options"], "--spp 2");
    EXPECT_EQ(header["metamarch/spp"], "2");
    EXPECT_EQ(header["metamarch/seed"], "5");
    EXPECT_EQ(header["metamarch/maxBounces"], "0");
    EXPECT_EQ(header["metamarch/camera"], view.name);
    EXPECT_TRUE(exr.findChannel("A"));
    EXPECT_FALSE(readImage(folder / "a.PNG").findChannel("A"));
}

INSTANTIATE_TEST_SUITE_P(Backends, Picture, testing::Values(Backend::cpu, Backend::device),
                         [](const auto& instance) { return nameOfBackend(instance.param); });

// The structure and its buffers are made once for several pictures.
TEST(DeviceScene, servesSeveralPictures) {
    const auto scene = std::make_shared<const Scene>(unitCube());
    LightChoice light;
    light.kind = LightChoice::Kind::background;
    light.background = glm::vec3(1.0f);
    render::PreparedScene prepared(scene, {});
    RenderSettings settings;
    settings.samplesPerPixel = 1;
    settings.traversal = traversals().front();
    prepared.light("cube", settings.path, light);
    const render::DeviceScene onDevice(vulkan::testDevice(), prepared);
    const Camera camera = makeCamera(frameBounds(boundsOf(*scene), kDefaultVerticalFov, 1.0f), 24, 24);
    const RenderResult first = renderPicture(onDevice, camera, settings);
    settings.path.integrator = Integrator::primary;
    EXPECT_EQ(renderPicture(onDevice, camera, settings).film.pixels.size(), 24u * 24u);
    settings.path.integrator = Integrator::path;
    const std::uint64_t bytes = onDevice.bytes();
    const RenderResult second = renderPicture(onDevice, camera, settings);
    EXPECT_EQ(onDevice.bytes(), bytes);
    EXPECT_EQ(countWhole(second.film.pixels, first.film.pixels), first.film.pixels.size());
}

} // namespace
} // namespace metamarch::tests
