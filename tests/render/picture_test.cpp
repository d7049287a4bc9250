// SPDX-License-Identifier: MIT
// renderPicture on the device and on the CPU: progress, cancelling, the result's members and its file.
#include "fixtures/shapes.h"
#include "fixtures/temporary_folder.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/film_run.h"
#include "metamarch/render/picture.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <random>
#include <stdexcept>
#include <variant>

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

    RenderResult render(const RenderSettings& settings, const render::RenderControl& control = {}) {
        if (!settings.isPrimary()) {
            lightFor(settings);
        }
        return GetParam() == Backend::cpu ? renderPicture(prepared, camera, settings, control)
                                          : renderPicture(render::DeviceScene(vulkan::testDevice(), prepared),
                                                          camera, settings, control);
    }

    // The same, with a scene that is on the device from one call to the next.
    RenderResult renderAgain(const RenderSettings& settings, const render::RenderControl& control = {}) {
        if (prepared.shading == nullptr) {
            lightFor(settings);
        }
        if (GetParam() == Backend::cpu) {
            return renderPicture(prepared, camera, settings, control);
        }
        if (!onDevice) {
            onDevice.emplace(vulkan::testDevice(), prepared);
        }
        return renderPicture(*onDevice, camera, settings, control);
    }

    // Stops at the first step of which `isOn` is false.
    static render::RenderControl until(const std::function<bool(double part)>& isOn) {
        return {.onStep = [isOn](const render::RenderProgress& progress) {
            return isOn(progress.part) ? render::RenderWish::goOn : render::RenderWish::stop;
        }};
    }

    static RenderSettings by(const Integrator integrator, const std::uint32_t samples = 1) {
        RenderSettings settings;
        settings.path.integrator = integrator;
        settings.samplesPerPixel = samples;
        return settings;
    }

    render::PreparedScene prepared;
    std::optional<render::DeviceScene> onDevice;
    SceneCamera view;
    Camera camera;
};

bool isSame(const FilmPixel& a, const FilmPixel& b) {
    using Words = std::array<std::uint32_t, sizeof(FilmPixel) / sizeof(std::uint32_t)>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

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
        const RenderResult result = render(by(integrator, 3), until([&](const double part) {
                                               parts.push_back(part);
                                               return true;
                                           }));
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
        const RenderResult result = render(by(integrator), until([](double) { return false; }));
        EXPECT_TRUE(result.isCancelled);
        const std::size_t pixels = countWhole(result.film.pixels, render(by(integrator)).film.pixels);
        EXPECT_GT(pixels, 0u);
        EXPECT_LT(pixels, result.film.pixels.size());
    }
}

TEST_P(Picture, isNotCancelledAtItsEnd) {
    const RenderResult result =
        render(by(Integrator::path), until([](const double part) { return part < 1.0; }));
    EXPECT_FALSE(result.isCancelled);
    EXPECT_EQ(countWhole(result.film.pixels, render(by(Integrator::path)).film.pixels),
              result.film.pixels.size());
}

// Random cuts of samples and areas.
TEST_P(Picture, anyPartitionAddsUp) {
    const RenderSettings settings = by(Integrator::direct, 20);
    const FilmData whole = renderAgain(settings).film;
    std::mt19937 random(7);
    for (int trial = 0; trial < (GetParam() == Backend::cpu ? 10 : 1); ++trial) {
        SCOPED_TRACE(trial);
        const auto below = [&](const std::uint32_t end) {
            return std::uniform_int_distribution<std::uint32_t>(1, end - 1)(random);
        };
        const std::uint32_t x = below(51);
        const std::uint32_t cut = below(20);
        render::FilmSum sum({0, 0, 51, 38}, 0);
        for (const auto& [first, end] : {std::pair(0u, cut), std::pair(cut, 20u)}) {
            for (const PixelRect& area : {PixelRect{0, 0, x, 38}, {x, 0, 51, 38}}) {
                RenderSettings part = settings;
                part.firstSample = first;
                part.samplesPerPixel = end;
                part.area = area;
                const RenderResult result = renderAgain(part, {.keepsSums = true});
                EXPECT_EQ(result.area, area);
                for (const render::FilmSpan& span : result.sums.spans) {
                    EXPECT_TRUE(sum.add(area, span));
                }
            }
        }
        EXPECT_EQ(countWhole(sum.take().pixels, whole.pixels), whole.pixels.size());
    }
}

TEST_P(Picture, goesOnFromWhereItWasStopped) {
    const RenderSettings settings = by(Integrator::direct, 40);
    const FilmData whole = renderAgain(settings).film;
    // A device compiles the kernel for each render.
    const std::vector<double> cpuParts = {0.1, 0.3, 0.5, 0.9};
    for (const double part : GetParam() == Backend::cpu ? cpuParts : std::vector{0.3}) {
        const RenderResult stopped =
            renderAgain(settings, until([&](const double done) { return done < part; }));
        EXPECT_TRUE(stopped.isCancelled);
        const RenderResult result = renderAgain(settings, {.start = stopped.sums});
        EXPECT_FALSE(result.isCancelled);
        EXPECT_LT(result.samplesTaken, 40.0 * 51 * 38);
        EXPECT_EQ(countWhole(result.film.pixels, whole.pixels), whole.pixels.size());
    }
}

// An adaptive picture takes fewer samples, and the same on both backends.
TEST_P(Picture, adaptiveSamplesAreThoseOfTheCpu) {
    RenderSettings settings = by(Integrator::direct, 64);
    settings.adaptive = {.threshold = 0.02, .minSamples = 16};
    const RenderResult result = render(settings);
    EXPECT_LT(result.counts.samples, 50.0 * 51 * 38);
    EXPECT_GT(result.counts.samples, 16.0 * 51 * 38);
    lightFor(settings);
    const RenderResult expected = renderPicture(prepared, camera, settings);
    for (std::size_t i = 0; i < expected.film.pixels.size(); ++i) {
        ASSERT_EQ(std::memcmp(&result.film.pixels[i], &expected.film.pixels[i], offsetof(FilmPixel, steps)),
                  0);
    }
}

TEST_P(Picture, saysWhatItTook) {
    const RenderResult result = render(by(Integrator::path, 2));
    const bool isOnDevice = GetParam() == Backend::device;
    EXPECT_EQ(result.device, isOnDevice ? vulkan::testDevice().name() : "cpu");
    EXPECT_EQ(result.traversal, traversals().front());
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
    render::writePicture(result, {"metamarch 0", "ball.glb", view, "--spp 2"}, {folder / "a.exr"});
    render::writePicture(result, {"metamarch 0", "ball.glb", view}, {folder / "a.PNG"});
    const Image exr = readImage(folder / "a.exr");
    std::map<std::string, std::string> header; // its texts
    for (const auto& [name, value] : exr.attributes) {
        if (const auto* const text = std::get_if<std::string>(&value)) {
            header[name] = *text;
        }
    }
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
