// SPDX-License-Identifier: MIT
// The filter of the display. A twin on the CPU judges its bits. What it is for is judged by a converged
// picture.
#include "fixtures/vulkan_environment.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/device_scene.h"
#include "metamarch/render/display_filter.h"
#include "metamarch/render/path_sampler.h"
#include "metamarch/render/tiling.h"
#include "metamarch/scene/import.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/shading.h"
#include "metamarch/shading/view.h"
#include "metamarch/shared/packed_pixel.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace metamarch::tests {
namespace {

constexpr int kWidth = 75; // neither is a multiple of a tile's side
constexpr int kHeight = 51;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

// The strength of the filter, as DisplayFilter has it.
FilterPush pushAt(const std::uint32_t samples) {
    const float strength = 1.0f - std::log2(static_cast<float>(samples)) / 5.0f;
    FilterPush push{};
    push.isSingle = samples == 1 ? 1 : 0;
    push.tolerance = 4.0f * strength;
    push.kept = 1.0f - (1.0f - strength) * (1.0f - strength);
    return push;
}

// The twin: the same sums in the same order.
class CpuFilter {
  public:
    CpuFilter(const std::vector<FilmPixel>& film, const std::uint32_t samples) : push(pushAt(samples)) {
        for (const FilmPixel& pixel : film) {
            surfaces.push_back(filterSurface(pixel));
            shapes.push_back(filterShape(pixel));
            before.push_back(filterLight(pixel));
        }
        after = before;
        forEach([&](const int x, const int y, const std::size_t i) { findVariance(x, y, i); });
        for (std::uint32_t pass = 0; pass < kFilterPasses; ++pass) {
            const std::vector<FilterLight> from = after;
            forEach([&](const int x, const int y, const std::size_t i) {
                after[i] = passed(from, x, y, i, 1 << pass);
            });
        }
    }

    vec3 radiance(const std::size_t i) const {
        return filteredRadiance(surfaces[i], before[i], after[i], push.kept);
    }

  private:
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                if (const std::size_t i = indexOf(x, y); surfaces[i].depth >= 0.0f) {
                    visit(x, y, i);
                }
            }
        }
    }
    static bool isInside(const int x, const int y) { return x >= 0 && y >= 0 && x < kWidth && y < kHeight; }
    static std::size_t indexOf(const int x, const int y) {
        return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
    }
    float depthAt(const int x, const int y) const {
        return isInside(x, y) ? surfaces[indexOf(x, y)].depth : kNotFiltered;
    }

    void findVariance(const int x, const int y, const std::size_t i) {
        const float here = surfaces[i].depth;
        shapes[i].slope =
            std::max(slopeBetween(depthAt(x - kSlopeReach, y), here, depthAt(x + kSlopeReach, y)),
                     slopeBetween(depthAt(x, y - kSlopeReach), here, depthAt(x, y + kSlopeReach)));
        const int reach = push.isSingle != 0 ? kFilterReach : 1;
        float weights = push.isSingle != 0 ? 1.0f : 0.0f;
        float sum = 0.0f;
        float squares = 0.0f;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                if (!isInside(x + dx, y + dy)) {
                    continue;
                }
                const std::size_t j = indexOf(x + dx, y + dy);
                if (push.isSingle == 0) {
                    if (surfaces[j].depth >= 0.0f) {
                        weights += binomial(dx, dy);
                        sum += binomial(dx, dy) * before[j].variance;
                    }
                } else if (j != i) {
                    const auto pixels = static_cast<float>(std::max(std::abs(dx), std::abs(dy)));
                    const float weight =
                        filterWeight(surfaces[i], shapes[i], surfaces[j], shapes[j], pixels, 0.0f);
                    const float change = luminance(before[j].light) - luminance(before[i].light);
                    weights += weight;
                    sum += weight * change;
                    squares += weight * change * change;
                }
            }
        }
        after[i].variance =
            push.isSingle == 0 ? sum / weights : std::max(squares / weights - squared(sum / weights), 0.0f);
    }

    FilterLight passed(const std::vector<FilterLight>& from, const int x, const int y, const std::size_t i,
                       const int distance) const {
        FilterSum sum = startFilterSum(from[i], binomial(0, 0));
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const int otherX = x + dx * distance;
                const int otherY = y + dy * distance;
                if (!isInside(otherX, otherY) || (dx == 0 && dy == 0)) {
                    continue;
                }
                const std::size_t j = indexOf(otherX, otherY);
                const float difference = lightDifference(from[i], from[j], push.tolerance);
                const float weight = filterWeight(surfaces[i], shapes[i], surfaces[j], shapes[j],
                                                  static_cast<float>(distance), difference);
                sum = addTo(sum, from[i], from[j], binomial(dx, dy) * weight);
            }
        }
        return meanOf(sum, from[i]);
    }

    FilterPush push;
    std::vector<FilterSurface> surfaces;
    std::vector<FilterShape> shapes;
    std::vector<FilterLight> before;
    std::vector<FilterLight> after;
};

class DisplayFilter : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    static render::PreparedScene prepared() {
        render::PreparedScene made(
            std::make_shared<const Scene>(
                loadScene(std::filesystem::path(METAMARCH_SOURCE_DIR) / "scenes" / "cornell.glb")),
            {});
        made.light("cornell.glb", {}, {});
        return made;
    }

    std::unique_ptr<render::PathTracer>
    tracer(const std::uint32_t tilesOfBand = render::DeviceFilm::kAllTiles,
           const std::uint32_t seed = 0) const {
        auto made = std::make_unique<render::PathTracer>(
            device, scene.buffers(), scene.shading(), std::string(traversals().front()), camera, kTiles, 0,
            std::span<const std::uint32_t>(), render::PathTracer::kFirstTurns, tilesOfBand);
        PathSettings seeded = settings();
        seeded.seed = seed;
        made->start(camera, seeded, {0, kTiles});
        return made;
    }

    std::unique_ptr<render::PathTracer>
    sampled(const std::uint32_t samples, const std::uint32_t tilesOfBand = render::DeviceFilm::kAllTiles,
            const std::uint32_t seed = 0) const {
        auto made = tracer(tilesOfBand, seed);
        while (made->samples() < samples) {
            made->advance(samples, kBlockSamples, render::WorkSize::kTargetSeconds);
        }
        return made;
    }

    PathSettings settings() const { return PathChoice{}.applied(scene.scene().shading->settings); }

    static std::vector<FilmPixel> filmOf(const render::PathTracer& from) {
        FilmData film(kPixels, 0);
        from.download(film);
        return film.pixels;
    }

    // Returns the picture of the tracer's film, with small submissions.
    std::vector<std::uint32_t> filtered(const render::PathTracer& from, const std::uint32_t samples,
                                        const ToneMapping& tone = {}) const {
        const vulkan::Buffer picture(device, vulkan::BufferUse::storage, kPixels * sizeof(std::uint32_t),
                                     "picture");
        render::DisplayFilter filter(device, from, picture, kPixels);
        EXPECT_FALSE(filter.isWorking());
        filter.start({kWidth, kHeight}, samples);
        while (!filter.advance(1e-3)) {
        }
        EXPECT_FALSE(filter.isWorking());
        vulkan::Submission(device).run([&](vulkan::Commands& commands) {
            commands.fill(picture, 0xff000000u);
            filter.show(commands, tone);
        });
        return vulkan::download<std::uint32_t>(device, picture);
    }

    // The same for a film that is made by hand, one function of the place.
    template <class Make>
    std::vector<std::uint32_t> filteredOf(const Make& make) const {
        FilmData film(kPixels, 0);
        for (std::size_t i = 0; i < kPixels; ++i) {
            film.pixels[i] = make(static_cast<int>(i % kWidth), static_cast<int>(i / kWidth));
        }
        const std::uint32_t samples = film.pixels.front().samples;
        const auto made = tracer();
        made->upload({}, film);
        return filtered(*made, samples);
    }

    static std::uint32_t shown(const vec3 radiance, const ToneMapping& tone = {}) {
        return packedLinear(toneMapped(tone, radiance));
    }

    // A wall at the distance 1 that faces the eye, with `samples` equal samples.
    static FilmPixel wall(const vec3 radiance, const vec3 albedo, const std::uint32_t samples) {
        FirstHit first = missFirst();
        first.albedo = albedo;
        first.t = 1.0f;
        first.depth = 1.0f;
        first.normal = vec3(0.0f, 0.0f, 1.0f);
        first.shadingNormal = first.normal;
        first.triangleId = 0;
        FilmPixel pixel = onlySample(radiance, first);
        for (std::uint32_t i = 1; i < samples; ++i) {
            pixel = addSample(pixel, radiance, first);
        }
        return pixel;
    }

    const vulkan::Device& device = vulkan::testDevice();
    render::DeviceScene scene{device, prepared()};
    SceneCamera view = scene.scene().scene->cameras.front();
    Camera camera = makeCamera(view, kWidth, kHeight, {});
    const std::uint32_t kTiles = render::Tiling(camera).count;
};

TEST_F(DisplayFilter, isThatOfTheTwin) {
    for (const std::uint32_t samples : {1u, 2u, 5u, 20u}) {
        SCOPED_TRACE(samples);
        const auto made = sampled(samples);
        const CpuFilter twin(filmOf(*made), samples);
        const ToneMapping tone{.toneOperator = kToneOperators[0].toneOperator, .exposure = 0.5f};
        const std::vector<std::uint32_t> picture = filtered(*made, samples, tone);
        for (std::size_t i = 0; i < kPixels; ++i) {
            ASSERT_EQ(picture[i], shown(twin.radiance(i), tone)) << "pixel " << i;
        }
    }
}

TEST_F(DisplayFilter, isTheSameInBands) { EXPECT_EQ(filtered(*sampled(2, 7), 2), filtered(*sampled(2), 2)); }

TEST_F(DisplayFilter, keepsAConstant) {
    const vec3 radiance(0.3f, 0.2f, 0.7f);
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto picture =
            filteredOf([&](int, int) { return wall(radiance, vec3(0.5f, 0.25f, 1.0f), samples); });
        EXPECT_EQ(std::ranges::count(picture, shown(radiance)), static_cast<std::ptrdiff_t>(kPixels));
    }
}

// Noise of single samples on a wall: dark and bright in turn, as a chessboard.
float chess(const int x, const int y) { return (x + y) % 2 == 0 ? 0.1f : 0.5f; }

// The largest difference of a byte to that of `radiance`, away from the picture's border.
int differenceTo(const std::vector<std::uint32_t>& picture, const vec3 radiance, const int left,
                 const int right) {
    const auto expected = static_cast<int>(packedLinear(toneMapped({}, radiance)) & 255u);
    int largest = 0;
    for (int y = 8; y < kHeight - 8; ++y) {
        for (int x = left; x < right; ++x) {
            const std::uint32_t pixel =
                picture[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
            largest = std::max(largest, std::abs(static_cast<int>(pixel & 255u) - expected));
        }
    }
    return largest;
}

TEST_F(DisplayFilter, takesNoiseAway) {
    const auto picture =
        filteredOf([](const int x, const int y) { return wall(vec3(chess(x, y)), vec3(0.5f), 1); });
    EXPECT_LE(differenceTo(picture, vec3(0.3f), 8, kWidth - 8), 15); // 0.1 and 0.5 are 60 and 39 bytes away
}

// Both sides of an edge have noise. Without the edge their means would mix; with it each side has its own.
TEST_F(DisplayFilter, keepsEdgesOfNormalAndDepth) {
    constexpr int kEdge = 37;
    const auto halves = [&](const auto& change) {
        return filteredOf([&](const int x, const int y) {
            const bool isRight = x >= kEdge;
            FilmPixel pixel = wall(vec3(chess(x, y) + (isRight ? 0.4f : 0.0f)), vec3(0.5f), 1);
            if (isRight) {
                change(pixel);
            }
            return pixel;
        });
    };
    const auto expectEdge = [&](const std::vector<std::uint32_t>& picture, const bool isKept) {
        const int left = differenceTo(picture, vec3(0.3f), kEdge - 2, kEdge);
        const int right = differenceTo(picture, vec3(0.7f), kEdge, kEdge + 2);
        EXPECT_EQ(std::max(left, right) <= 14, isKept) << left << ", " << right;
    };
    expectEdge(halves([](FilmPixel&) {}), false);
    expectEdge(halves([](FilmPixel& pixel) { pixel.seen.shadingNormal = vec3(1.0f, 0.0f, 0.0f); }), true);
    expectEdge(halves([](FilmPixel& pixel) { pixel.seen.t = 1.2f; }), true);
}

// A texture in even light stays sharp to the pixel, although the light is noisy.
TEST_F(DisplayFilter, keepsEdgesOfAlbedo) {
    const auto picture = filteredOf([](const int x, const int) {
        const float albedo = x % 3 == 0 ? 0.2f : 0.8f;
        return wall(vec3(0.5f * albedo), vec3(albedo), 1);
    });
    for (std::size_t i = 0; i < kPixels; ++i) {
        ASSERT_EQ(picture[i], shown(vec3(i % kWidth % 3 == 0 ? 0.1f : 0.4f))) << "pixel " << i;
    }
}

// What the first sample misses stays as it is, also beside noise.
TEST_F(DisplayFilter, leavesTheSurroundingsAlone) {
    const auto radianceAt = [](const int x, const int y) {
        return vec3(chess(x, y) + (x % 7 == 0 ? 0.3f : 0.0f));
    };
    const auto picture = filteredOf([&](const int x, const int y) {
        return x < 30 ? onlySample(radianceAt(x, y), missFirst()) : wall(radianceAt(x, y), vec3(0.5f), 1);
    });
    for (std::size_t i = 0; i < kPixels; ++i) {
        if (const int x = static_cast<int>(i % kWidth); x < 30) {
            ASSERT_EQ(picture[i], shown(radianceAt(x, static_cast<int>(i / kWidth)))) << "pixel " << i;
        }
    }
}

double errorOf(const std::vector<std::uint32_t>& picture, const std::vector<std::uint32_t>& converged) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        for (const unsigned shift : {0u, 8u, 16u}) {
            const double difference =
                static_cast<double>((picture[i] >> shift) & 255u) - ((converged[i] >> shift) & 255u);
            sum += difference * difference;
        }
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(picture.size()))) / 255.0;
}

TEST_F(DisplayFilter, bringsAPictureCloserToTheConvergedOne) {
    const auto plain = [](const render::PathTracer& made) {
        std::vector<std::uint32_t> pixels;
        for (const FilmPixel& pixel : filmOf(made)) {
            pixels.push_back(shown(meanRadiance(pixel)));
        }
        return pixels;
    };
    const std::vector<std::uint32_t> converged = plain(*sampled(1024));
    // The most that is left of the error, in the mean of several pictures: one scatters by a twentieth.
    constexpr std::uint32_t kPictures = 8;
    for (const auto& [samples, most] : {std::pair(1u, 0.5), {4u, 0.7}, {16u, 0.95}}) {
        double before = 0.0;
        double after = 0.0;
        for (std::uint32_t seed = 0; seed < kPictures; ++seed) {
            const auto made = sampled(samples, render::DeviceFilm::kAllTiles, seed);
            before += errorOf(plain(*made), converged) / kPictures;
            after += errorOf(filtered(*made, samples), converged) / kPictures;
        }
        EXPECT_LE(after, most * before) << samples << " samples, " << before << " before";
        RecordProperty("samples" + std::to_string(samples), std::to_string(after / before));
    }
}

} // namespace
} // namespace metamarch::tests
