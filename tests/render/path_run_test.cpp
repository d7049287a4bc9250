// SPDX-License-Identifier: MIT
// Passes, sums and files of sums, with a sampler whose samples are numbers. The device's and the CPU's
// samplers are tested in tests/path and tests/cli.
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/render/adaptive.h"
#include "metamarch/render/film_file.h"
#include "metamarch/render/noise.h"
#include "metamarch/render/path_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

namespace metamarch::tests {
namespace {

using render::FilmRun;
using render::FilmSpan;
using render::FilmSum;
using render::PathRun;
using render::PathSums;
using render::RenderControl;
using render::RenderProgress;
using render::RenderWish;
using render::SampleRange;

constexpr PixelRect kArea{0, 0, 3, 2};

render::PathWork work(const PixelRect& area = kArea) {
    return {.settings = {}, .camera = {}, .area = area, .request = {.parts = kFilmLight}};
}

// Radiances whose sums depend on the order of their addition.
glm::vec3 radianceOf(const std::size_t pixel, const std::uint32_t sample) {
    const auto phase = static_cast<float>(pixel * 131 + std::size_t{sample} * 17);
    return glm::vec3(1.0f, 0.1f, 1e-4f) * std::exp(8.0f * std::sin(phase));
}

void addTo(FilmData& film, const std::size_t pixel, const std::uint32_t sample) {
    const glm::vec3 radiance = radianceOf(pixel, sample);
    FirstHit first = missFirst();
    first.triangleId = sample;
    LightParts light = noLight();
    light.direct = radiance;
    film.light[pixel] = addSampleLight(film.light[pixel], radiance, light);
    film.pixels[pixel] = addSample(film.pixels[pixel], radiance, first);
}

// Takes a pixel at a time. Throws once it has taken `failAfter` pixels.
class NumberSampler : public render::PathSampler {
  public:
    void start(PathSums sums) override { sums_ = std::move(sums); }
    bool take(const std::uint32_t endSample, const OnProgress& onProgress) override {
        if (endSample > sums_.blockFirst + kBlockSamples) {
            addBlock(sums_.earlier, sums_.block);
            sums_.block = FilmData(kArea.pixelCount(), kFilmLight);
            sums_.blockFirst += kBlockSamples;
        }
        for (std::size_t pixel = 0; pixel < kArea.pixelCount(); ++pixel) {
            if (sums_.block.pixels[pixel].samples >= endSample - sums_.blockFirst) {
                continue;
            }
            if (failAfter-- == 0) {
                throw Error(ErrorKind::noDevice, "device lost");
            }
            while ((active_.empty() || active_[pixel] != 0) &&
                   sums_.block.pixels[pixel].samples < endSample - sums_.blockFirst) {
                addTo(sums_.block, pixel, sums_.blockFirst + sums_.block.pixels[pixel].samples);
            }
            const double part = static_cast<double>(pixel + 1) / static_cast<double>(kArea.pixelCount());
            if (onProgress && !onProgress(part)) {
                return pixel + 1 == kArea.pixelCount();
            }
        }
        return true;
    }
    void setActive(std::vector<std::uint8_t> active) override { active_ = std::move(active); }
    PathSums sums() const override { return sums_; }

    int failAfter = -1;

  private:
    PathSums sums_;
    std::vector<std::uint8_t> active_;
};

// The definition: blocks in their order, each from nothing.
FilmData definition(const std::uint32_t samples) {
    FilmData film(kArea.pixelCount(), kFilmLight);
    for (std::uint32_t first = 0; first < samples; first += kBlockSamples) {
        FilmData block(kArea.pixelCount(), kFilmLight);
        for (std::size_t pixel = 0; pixel < kArea.pixelCount(); ++pixel) {
            for (std::uint32_t sample = first; sample < std::min(first + kBlockSamples, samples); ++sample) {
                addTo(block, pixel, sample);
            }
        }
        addBlock(film, block);
    }
    return film;
}

void expectSame(const FilmData& a, const FilmData& b) {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    ASSERT_EQ(a.light.size(), b.light.size());
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(FilmPixel)), 0);
    EXPECT_EQ(std::memcmp(a.light.data(), b.light.data(), a.light.size() * sizeof(LightParts)), 0);
}

FilmRun runOf(const SampleRange range, const RenderControl& control = {}) {
    NumberSampler sampler;
    PathRun run(sampler, work(), range, control);
    run.take([](const RenderProgress&) {});
    return run.sums();
}

FilmData sumOf(const std::vector<FilmRun>& runs) {
    FilmSum sum(kArea, kFilmLight);
    for (const FilmRun& run : runs) {
        for (const FilmSpan& span : run.spans) {
            EXPECT_TRUE(sum.add(run.area, span)) << span.firstSample;
        }
    }
    return sum.take();
}

TEST(TilesAtOnce, fillHalfOfTheFreeMemoryAtMost) {
    EXPECT_EQ(render::tilesAtOnce(5000, 8192, 1u << 30, 1u << 14), 5000u); // all
    EXPECT_EQ(render::tilesAtOnce(5000, 4096, 1u << 30, 1u << 14), 4096u);
    EXPECT_EQ(render::tilesAtOnce(5000, 4096, 1u << 25, 1u << 14), 1024u); // 32 MiB free, 16 KiB a tile
    EXPECT_EQ(render::tilesAtOnce(5000, 4096, 0, 1u << 14), 256u);         // worth a try
    EXPECT_EQ(render::tilesAtOnce(100, 4096, 0, 1u << 14), 100u);
}

TEST(PathRun, anyDivisionOfTheSamplesHasTheSumsOfTheWhole) {
    for (std::uint32_t cut = 0; cut < 40; ++cut) {
        SCOPED_TRACE(cut);
        std::vector<FilmRun> runs;
        if (cut > 0) {
            runs.push_back(runOf({0, cut}));
        }
        runs.push_back(runOf({cut, 40}));
        expectSame(sumOf(runs), definition(40));
    }
    expectSame(sumOf({runOf({0, 3}), runOf({3, 9}), runOf({9, 21}), runOf({21, 64})}), definition(64));
}

// Ends after each number of steps, and goes on from there.
TEST(PathRun, goesOnFromWhereItWasStopped) {
    for (const SampleRange range : {SampleRange{0, 40}, SampleRange{5, 40}, SampleRange{16, 37}}) {
        const FilmRun whole = runOf(range);
        for (int steps = 1; steps < 25; ++steps) {
            SCOPED_TRACE(steps);
            int left = steps;
            const RenderControl first{.onStep = [&](const RenderProgress&) {
                return --left == 0 ? RenderWish::stop : RenderWish::goOn;
            }};
            RenderControl second;
            second.start = runOf(range, first);
            const FilmRun continued = runOf(range, second);
            ASSERT_EQ(continued.spans.size(), whole.spans.size());
            for (std::size_t i = 0; i < whole.spans.size(); ++i) {
                EXPECT_EQ(continued.spans[i].firstSample, whole.spans[i].firstSample);
                expectSame(*continued.spans[i].film, *whole.spans[i].film);
            }
        }
    }
}

std::string contentOf(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

TEST(FilmFile, keepsEveryBit) {
    const TemporaryFolder folder;
    std::vector<FilmRun> runs = {runOf({3, 40}), runOf({0, 3})};
    runs[1].seen = std::vector<SeenPoint>(6, {{1.0f, -0.0f, 3.0f}, {0.25f, 0.5f}, 7, 8, kNoId});
    const render::FilmFile file{{{"name", "value"}, {"other", ""}}, "a b.glb", 3, 2,
                                {{"CryptoObject", {"a", "b"}}},     {}};
    render::writeFilmFile(file, runs, folder / "a.part");
    const render::FilmFile read = render::readFilmFile(folder / "a.part");
    EXPECT_EQ(read.facts, file.facts);
    EXPECT_EQ(read.sceneFile, "a b.glb");
    EXPECT_EQ(read.width, 3u);
    EXPECT_EQ(read.height, 2u);
    ASSERT_EQ(read.cryptomatte.size(), 1u);
    EXPECT_EQ(read.cryptomatte.front().layer, "CryptoObject");
    EXPECT_EQ(read.cryptomatte.front().nameOfGroup, (std::vector<std::string>{"a", "b"}));
    ASSERT_EQ(read.runs.size(), 2u);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        EXPECT_EQ(read.runs[i].area, kArea);
        EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(read.runs[i].seen)),
                                       std::as_bytes(std::span(runs[i].seen))));
        ASSERT_EQ(read.runs[i].spans.size(), runs[i].spans.size());
        for (std::size_t j = 0; j < runs[i].spans.size(); ++j) {
            EXPECT_EQ(read.runs[i].spans[j].firstSample, runs[i].spans[j].firstSample);
            expectSame(*read.runs[i].spans[j].film, *runs[i].spans[j].film);
        }
    }
    EXPECT_EQ(render::differingFact(file.facts, read.facts), std::nullopt);
    EXPECT_EQ(render::differingFact(file.facts, {{"name", "value"}, {"other", "x"}}), "other");
    EXPECT_EQ(render::differingFact(file.facts, {{"name", "value"}}), "other");
    EXPECT_EQ(render::differingFact({{"name", "value"}}, file.facts), "other");
}

TEST(FilmFile, groupsHaveNames) {
    const TemporaryFolder folder;
    FilmData film(kArea.pixelCount(), kFilmHits);
    FilmRun run{kArea, {}};
    const render::FilmFile file{{}, "", 3, 2, {{"CryptoObject", {"a", "b"}}}, {}};
    film.addHit(5, 1);
    run.spans = {{0, film}};
    render::writeFilmFile(file, {&run, 1}, folder / "a.part");
    EXPECT_EQ(render::readFilmFile(folder / "a.part").runs.size(), 1u);
    film.addHit(5, 2);
    run.spans = {{0, film}};
    render::writeFilmFile(file, {&run, 1}, folder / "b.part");
    expectError(ErrorKind::inputRefused, "damaged", [&] { render::readFilmFile(folder / "b.part"); });
}

TEST(PathRun, showsThePictureAndGoesOn) {
    int shown = 0;
    NumberSampler sampler;
    const RenderControl control{.onStep = [](const RenderProgress&) { return RenderWish::show; }};
    PathRun run(sampler, work(), {0, 20}, control);
    EXPECT_TRUE(run.take([&](const RenderProgress& progress) {
        ++shown;
        EXPECT_LE(progress.nextSample, 20u);
        EXPECT_FALSE(run.sums().spans.empty());
    }));
    EXPECT_GE(shown, 12); // two passes over six pixels
    expectSame(sumOf({run.sums()}), definition(20));
}

TEST(PathRun, progressRises) {
    std::vector<double> parts;
    double taken = 0.0;
    const RenderControl control{.onStep = [&](const RenderProgress& progress) {
        parts.push_back(progress.part);
        taken = progress.samples;
        EXPECT_EQ(progress.samples + progress.samplesLeft, 6.0 * 40);
        return RenderWish::goOn;
    }};
    runOf({0, 40}, control);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
    EXPECT_EQ(parts.back(), 1.0);
    EXPECT_EQ(taken, 6.0 * 40);
}

// No time is left after the first pass, which has one sample.
TEST(PathRun, aTimeLimitEndsWithEqualSamples) {
    const RenderControl control{.timeLimit = 0.0};
    NumberSampler sampler;
    PathRun run(sampler, work(), {0, 100}, control);
    EXPECT_TRUE(run.take([](const RenderProgress&) {}));
    EXPECT_EQ(run.samples(), 1u);
    expectSame(sumOf({run.sums()}), definition(1));
}

TEST(PathRun, keepsWhatWasTakenBeforeAFailure) {
    NumberSampler sampler;
    sampler.failAfter = 8;
    const RenderControl control;
    PathRun run(sampler, work(), {0, 100}, control);
    EXPECT_THROW(run.take([](const RenderProgress&) {}), Error);
    EXPECT_EQ(run.samples(), 16u);
    const FilmData film = sumOf({run.sums()});
    EXPECT_EQ(film.pixels[1].samples, 32u);
    EXPECT_EQ(film.pixels[2].samples, 16u);
}

// A film of 40 x 40 pixels with `samples` samples, of which the left half is noisier.
FilmData unevenFilm(const std::uint32_t samples) {
    FilmData film(1600, 0);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const float amplitude = i % 40 < 20 ? 0.9f : 0.01f;
        for (std::uint32_t sample = 0; sample < samples; ++sample) {
            const float value = 1.0f + (sample % 2 == 0 ? amplitude : -amplitude);
            film.pixels[i] = addSample(film.pixels[i], glm::vec3(value), missFirst());
        }
    }
    return film;
}

// 16 samples of standard deviation 0.9 and mean 1 leave an error of 0.23, those of 0.01 one of 0.0026.
TEST(Adaptive, stopsWhereTheErrorIsSmall) {
    const std::vector<std::uint8_t> active = render::activePixels(unevenFilm(16), 40, 16, 0.05);
    EXPECT_EQ(active[0], 1);
    EXPECT_EQ(active[39], 0);
    EXPECT_EQ(std::ranges::count(render::activePixels(unevenFilm(16), 40, 16, 0.25), 1), 0);
    EXPECT_EQ(std::ranges::count(render::activePixels(unevenFilm(16), 40, 16, 0.001), 0), 0);
    // Pixels with fewer samples have stopped.
    EXPECT_EQ(std::ranges::count(render::activePixels(unevenFilm(16), 40, 32, 0.0001), 1), 0);
}

// What a pixel's own samples, and those of its colour of the chessboard, are has no part in its decision.
TEST(Adaptive, noPixelDecidesByItsOwnSamples) {
    const FilmData calm = unevenFilm(16);
    const std::vector<std::uint8_t> before = render::activePixels(calm, 40, 16, 0.05);
    for (const std::size_t pixel : {0u, 30u, 47u, 1599u, 39u}) {
        FilmData lucky = calm;
        lucky.pixels[pixel].squares = glm::vec3(1e6f);
        const std::vector<std::uint8_t> after = render::activePixels(lucky, 40, 16, 0.05);
        EXPECT_EQ(after[pixel], before[pixel]) << pixel;
        const std::size_t neighbor = pixel % 40 > 0 ? pixel - 1 : pixel + 1;
        EXPECT_EQ(after[neighbor], 1) << pixel;
    }
}

// 5 x 3 tiles. A sample's radiance is m * E with the mean m: 1 on the left, where E is 1 or nearly so; 0.5 on
// the right, where it is 0 in nine of ten samples and 10 in the tenth, as light is that paths seldom find.
constexpr PixelRect kUneven{0, 0, 40, 24};

bool isNoisy(const std::size_t pixel) { return pixel % kUneven.width() >= 24; }
double meanAt(const std::size_t pixel) { return isNoisy(pixel) ? 0.5 : 1.0; }

class UnevenSampler : public render::PathSampler {
  public:
    explicit UnevenSampler(const std::uint32_t seed) : seed_(seed) {}

    void start(PathSums sums) override { sums_ = std::move(sums); }
    void setActive(std::vector<std::uint8_t> active) override { active_ = std::move(active); }
    PathSums sums() const override { return sums_; }
    bool take(const std::uint32_t endSample, const OnProgress& onProgress) override {
        if (endSample > sums_.blockFirst + kBlockSamples) {
            addBlock(sums_.earlier, sums_.block);
            sums_.block = FilmData(kUneven.pixelCount(), kFilmLight);
            sums_.blockFirst += kBlockSamples;
        }
        const std::uint32_t wanted = endSample - sums_.blockFirst;
        for (std::size_t pixel = 0; pixel < kUneven.pixelCount(); ++pixel) {
            FilmPixel& sum = sums_.block.pixels[pixel];
            if (sum.samples >= wanted || (!active_.empty() && active_[pixel] == 0)) {
                continue;
            }
            while (sum.samples < wanted) {
                sum = addSample(sum, radiance(pixel, sums_.blockFirst + sum.samples), missFirst());
            }
            if (onProgress && pixel % 100 == 0 && !onProgress(0.5)) {
                return false;
            }
        }
        return true;
    }

  private:
    glm::vec3 radiance(const std::size_t pixel, const std::uint32_t sample) const {
        // SplitMix64.
        std::uint64_t z =
            (std::uint64_t{seed_} << 40u | std::uint64_t{sample} << 20u | pixel) * 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
        const float u = static_cast<float>((z ^ (z >> 31u)) >> 40u) * 0x1p-24f;
        const float factor = isNoisy(pixel) ? (u < 0.1f ? 10.0f : 0.0f) : 0.95f + 0.1f * u;
        return glm::vec3(static_cast<float>(meanAt(pixel)) * factor);
    }

    std::uint32_t seed_;
    PathSums sums_;
    std::vector<std::uint8_t> active_;
};

FilmRun unevenRun(const std::uint32_t seed, const std::uint32_t samples, const double threshold,
                  const RenderControl& control = {}) {
    UnevenSampler sampler(seed);
    PathRun run(sampler, work(kUneven), {0, samples}, control, {.threshold = threshold, .minSamples = 16});
    run.take([](const RenderProgress&) {});
    return run.sums();
}

FilmData sumOfUneven(const FilmRun& run) {
    FilmSum sum(kUneven, kFilmLight);
    for (const FilmSpan& span : run.spans) {
        EXPECT_TRUE(sum.add(run.area, span));
    }
    return sum.take();
}

// A sample of the noisy side has the variance 0.25 * 9; after 256 samples its error is 0.094 / sqrt(0.5) =
// 0.13.
constexpr double kGoodEnough = 0.15;

TEST(PathRun, adaptiveSumsDoNotDependOnTheCut) {
    const FilmData whole = sumOfUneven(unevenRun(1, 480, kGoodEnough));
    EXPECT_EQ(whole.pixels[0].samples, 16u);
    EXPECT_GT(whole.samples(), 96u);
    EXPECT_LT(whole.samples(), 480u);
    for (int steps = 1; steps < 100; steps += 7) {
        SCOPED_TRACE(steps);
        int left = steps;
        const RenderControl first{.onStep = [&](const RenderProgress&) {
            return --left == 0 ? RenderWish::stop : RenderWish::goOn;
        }};
        const RenderControl second{.start = unevenRun(1, 480, kGoodEnough, first)};
        expectSame(sumOfUneven(unevenRun(1, 480, kGoodEnough, second)), whole);
    }
}

// The z-test of a mean over 64 renders against the known mean, for each side of the picture.
TEST(PathRun, adaptiveMeansAreUnbiased) {
    for (const bool noisy : {false, true}) {
        double sum = 0.0;
        double squares = 0.0;
        double samples = 0.0;
        double pixels = 0.0;
        for (std::uint32_t seed = 0; seed < 64; ++seed) {
            const FilmData film = sumOfUneven(unevenRun(seed, 160, kGoodEnough * 2));
            double mean = 0.0;
            double count = 0.0;
            for (std::size_t i = 0; i < film.pixels.size(); ++i) {
                if (isNoisy(i) == noisy) {
                    mean += film.pixels[i].radiance.r / static_cast<float>(film.pixels[i].samples);
                    samples += film.pixels[i].samples;
                    count += 1.0;
                }
            }
            sum += mean / count;
            squares += mean / count * (mean / count);
            pixels += count;
        }
        const double mean = sum / 64;
        const double error = std::sqrt((squares / 64 - mean * mean) / 63);
        EXPECT_LT(std::abs(mean - (noisy ? 0.5 : 1.0)), 3.5 * error) << noisy;
        EXPECT_LT(samples / pixels, noisy ? 155.0 : 17.0); // it does stop
    }
}

TEST(PathRun, adaptiveRendersNeedFewerSamplesForTheSameError) {
    const auto errorOf = [](const FilmData& film) {
        double squares = 0.0;
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const double error =
                film.pixels[i].radiance.r / static_cast<float>(film.pixels[i].samples) - meanAt(i);
            squares += error * error;
        }
        return std::sqrt(squares / static_cast<double>(film.pixels.size()));
    };
    const FilmData adaptive = sumOfUneven(unevenRun(3, 256, kGoodEnough * 1.1));
    double samples = 0.0;
    for (const FilmPixel& pixel : adaptive.pixels) {
        samples += pixel.samples;
    }
    const auto mean = static_cast<std::uint32_t>(samples / static_cast<double>(adaptive.pixels.size()));
    const FilmData plain = sumOfUneven(unevenRun(4, mean, 0.0));
    EXPECT_LT(errorOf(adaptive), 0.8 * errorOf(plain)) << mean;
}

// Any file that is cut off or has another bit is refused, before memory is taken for it.
TEST(FilmFile, damageIsRefused) {
    const TemporaryFolder folder;
    render::writeFilmFile({{{"name", "value"}}, "a.glb", 3, 2, {}, {}}, std::vector{runOf({0, 20})},
                          folder / "a");
    const std::string whole = contentOf(folder / "a");
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        std::string bytes = whole;
        const std::size_t at = random() % bytes.size();
        if (trial % 2 == 0) {
            bytes.resize(at);
        } else {
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        }
        std::ofstream(folder / "b", std::ios::binary) << bytes;
        expectError(ErrorKind::inputRefused, "b: ", [&] { render::readFilmFile(folder / "b"); });
    }
    std::ofstream(folder / "b", std::ios::binary) << whole << 'x';
    expectError(ErrorKind::inputRefused, "damaged", [&] { render::readFilmFile(folder / "b"); });
    std::string huge = whole;
    huge.replace(24, 16, 16, '\x3f'); // the sizes that the file claims
    std::ofstream(folder / "b", std::ios::binary) << huge;
    expectError(ErrorKind::inputRefused, "damaged", [&] { render::readFilmFile(folder / "b"); });
}

// Each pass of such a range has a film of its own. A checkpoint each minute must not copy them all.
TEST(PathRun, sumsShareTheFilmsOfWholePasses) {
    NumberSampler sampler;
    const RenderControl control;
    PathRun run(sampler, work(), {16, 80}, control);
    run.take([](const RenderProgress&) {});
    const FilmRun first = run.sums();
    const FilmRun second = run.sums();
    ASSERT_EQ(first.spans.size(), 4u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(first.spans[i].film, second.spans[i].film);
    }
}

TEST(FilmSum, refusesWhatDoesNotFollow) {
    FilmSum sum(kArea, kFilmLight);
    EXPECT_FALSE(sum.add(kArea, runOf({16, 32}).spans.front())); // a gap
    EXPECT_EQ(sum.failed(), 0u);
    EXPECT_TRUE(sum.add(kArea, runOf({0, 16}).spans.front()));
    EXPECT_FALSE(sum.add(kArea, runOf({0, 16}).spans.front())); // twice
    // Samples 4 to 8 added up do not fit behind samples 0 to 4: float sums are no longer those of a block.
    FilmSum begun(kArea, kFilmLight);
    EXPECT_TRUE(begun.add(kArea, runOf({0, 4}).spans.front()));
    FilmData joined(kArea.pixelCount(), kFilmLight);
    for (const FilmSpan& span : runOf({4, 8}).spans) {
        addBlock(joined, *span.film);
    }
    EXPECT_FALSE(begun.add(kArea, {4, joined}));
}

TEST(Noise, isTheStandardErrorRelativeToTheMean) {
    FilmData film(1, 0);
    EXPECT_FALSE(render::noiseOf(film));
    for (const float value : {1.0f, 3.0f, 1.0f, 3.0f}) {
        film.pixels[0] = addSample(film.pixels[0], glm::vec3(value), missFirst());
    }
    // Mean 2; the samples' variance is 4/3, the mean's 1/3.
    EXPECT_NEAR(render::noiseOf(film).value(), std::sqrt(1.0 / 3.0) / 2.0, 1e-6);
}

} // namespace
} // namespace metamarch::tests
