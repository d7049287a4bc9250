// SPDX-License-Identifier: MIT
#include "metamarch/image/aov.h"

#include "metamarch/error/error.h"
#include "metamarch/shared/math.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace metamarch {
namespace {

bool isMiss(const AovPixel& pixel) { return pixel.film.seen.triangleId == kNoTriangle; }

// counted() is the number of samples in the sums, taken() that of all samples; both are at least 1.
float counted(const AovPixel& pixel) {
    return static_cast<float>(std::max(pixel.film.samples - pixel.film.rejected, 1u));
}
float taken(const AovPixel& pixel) { return static_cast<float>(std::max(pixel.film.samples, 1u)); }

// The variance of the pixel's mean, as if its samples were independent. Stratified samples have less.
glm::vec3 varianceOfMean(const AovPixel& pixel) {
    const float count = counted(pixel);
    const glm::vec3 mean = meanRadiance(pixel.film);
    const glm::vec3 spread = glm::max(pixel.film.squares / count - mean * mean, glm::vec3(0.0f));
    return spread / std::max(count - 1.0f, 1.0f);
}

// Returns, channel by channel, the part of the light that the objects leave to the shadow catcher.
glm::vec3 leftLight(const LightParts& light) {
    glm::vec3 left(1.0f);
    for (int i = 0; i < 3; ++i) {
        const float part = light.reached[i] / light.unblocked[i];
        left[i] = light.unblocked[i] > 0.0f && std::isfinite(part) ? part : 1.0f;
    }
    return left;
}

// Returns the part of the shadow catcher that objects in its mirror leave, 0 to 1.
float unmirrored(const LightParts& light) {
    return light.mirrorSamples > 0.0f ? 1.0f - light.mirrored / light.mirrorSamples : 1.0f;
}

// Returns the radiance of what is seen through the shadow catcher.
glm::vec3 seenBehind(const AovPixel& pixel) {
    return pixel.light.behind * leftLight(pixel.light) * (unmirrored(pixel.light) / counted(pixel));
}

glm::vec3 radianceOf(const AovPixel& pixel) {
    const glm::vec3 mean = meanRadiance(pixel.film);
    return pixel.light.caught > 0.0f ? mean + seenBehind(pixel) : mean;
}

// It is not limited to 0: a mean of noise that is cut off on one side would be a haze over the ground.
float coverageOf(const AovPixel& pixel) {
    const float left = luminance(leftLight(pixel.light)) * unmirrored(pixel.light);
    return (pixel.film.covered + pixel.light.caught * (1.0f - left)) / counted(pixel);
}

// A channel is the mean over the pixel's samples unless its meaning says otherwise.
constexpr Aov kAovs[] = {
    {.names = "R G B",
     .meaning = "radiance, linear",
     .value = radianceOf,
     .use = AovUse::always,
     .precision = AovPrecision::small},
    {.names = "A",
     .meaning = "part of the pixel that something covers, or that a shadow catcher darkens or mirrors, "
                "0 to 1; below 0 where objects brighten the catcher",
     .value = [](const AovPixel& pixel) { return glm::vec3(coverageOf(pixel)); },
     .use = AovUse::always,
     .precision = AovPrecision::small},
    {.names = "Z",
     .meaning = "distance along the view axis, in units of the scene; infinite, or what is asked, where "
                "the first sample misses",
     .value =
         [](const AovPixel& pixel) {
             return glm::vec3(isMiss(pixel) ? pixel.missDepth : pixel.film.seen.depth);
         }},
    {.names = "t",
     .meaning = "distance along the ray, likewise",
     .value =
         [](const AovPixel& pixel) {
             return glm::vec3(isMiss(pixel) ? pixel.missDepth : pixel.film.seen.t);
         }},
    {.names = "N.X N.Y N.Z",
     .meaning = "geometric normal in world space",
     .value = [](const AovPixel& pixel) { return pixel.film.seen.normal / counted(pixel); },
     .precision = AovPrecision::small},
    {.names = "Ns.X Ns.Y Ns.Z",
     .meaning = "shading normal in world space",
     .value = [](const AovPixel& pixel) { return pixel.film.seen.shadingNormal / counted(pixel); },
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small},
    {.names = "albedo.R albedo.G albedo.B",
     .meaning = "part of white light that the surface reflects",
     .value = [](const AovPixel& pixel) { return pixel.film.seen.albedo / counted(pixel); },
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small},
    {.names = "variance.R variance.G variance.B",
     .meaning = "variance of the means R G B",
     .value = varianceOfMean,
     .writer = AovWriter::pathTracer},
    {.names = "emission.R emission.G emission.B",
     .meaning = "radiance of lights and surroundings as the camera sees them",
     .value = [](const AovPixel& pixel) { return pixel.light.emission / counted(pixel) + seenBehind(pixel); },
     .use = AovUse::asked,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "direct.R direct.G direct.B",
     .meaning = "radiance of light that one surface scattered",
     .value = [](const AovPixel& pixel) { return pixel.light.direct / counted(pixel); },
     .use = AovUse::asked,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "indirect.R indirect.G indirect.B",
     .meaning = "radiance of light that more surfaces scattered; the three add up to R G B",
     .value = [](const AovPixel& pixel) { return pixel.light.indirect / counted(pixel); },
     .use = AovUse::asked,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "shadow.R shadow.G shadow.B",
     .meaning = "part of the light that objects leave to the shadow catcher; 1 where it is not seen",
     .value = [](const AovPixel& pixel) { return leftLight(pixel.light); },
     .use = AovUse::asked,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "noisy.R noisy.G noisy.B",
     .meaning = "R G B before the noise was removed",
     .value = radianceOf,
     .use = AovUse::denoised,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small},
    {.names = "noisy.direct.R noisy.direct.G noisy.direct.B",
     .meaning = "direct before the noise was removed",
     .value = [](const AovPixel& pixel) { return pixel.light.direct / counted(pixel); },
     .use = AovUse::denoised,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "noisy.indirect.R noisy.indirect.G noisy.indirect.B",
     .meaning = "indirect before the noise was removed",
     .value = [](const AovPixel& pixel) { return pixel.light.indirect / counted(pixel); },
     .use = AovUse::denoised,
     .writer = AovWriter::pathTracer,
     .precision = AovPrecision::small,
     .filmParts = kFilmLight},
    {.names = "P.X P.Y P.Z",
     .meaning = "point in world space that the first sample sees; 0 for a miss",
     .value = [](const AovPixel& pixel) { return pixel.seen.position; },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "UV.U UV.V",
     .meaning = "its texture coordinates, as glTF has them; 0 for a miss",
     .value = [](const AovPixel& pixel) { return glm::vec3(pixel.seen.uv, 0.0f); },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "motion.X motion.Y",
     .meaning = "its shift until the next frame, in pixels to the right and up; 0 for a miss",
     .value = [](const AovPixel& pixel) { return glm::vec3(pixel.seen.motion, 0.0f); },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "id.triangle",
     .meaning = "triangle that the first sample sees; 4294967295 for a miss",
     .id = [](const AovPixel& pixel) { return isMiss(pixel) ? kNoId : pixel.film.seen.triangleId; }},
    {.names = "id.mesh",
     .meaning = "its mesh, by its index in the file; likewise",
     .id = [](const AovPixel& pixel) { return pixel.seen.mesh; },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "id.instance",
     .meaning = "its mesh at its place in the scene, of which a mesh can have several; likewise",
     .id = [](const AovPixel& pixel) { return pixel.seen.instance; },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "id.material",
     .meaning = "its material; likewise, also without a material",
     .id = [](const AovPixel& pixel) { return pixel.seen.material; },
     .use = AovUse::asked,
     .isOfSeenPoint = true},
    {.names = "cryptomatte",
     .meaning = "channels CryptoObject00.R to CryptoAsset02.A: how much of the pixel is of which object, "
                "material or asset",
     .use = AovUse::asked,
     .writer = AovWriter::pathTracer,
     .filmParts = kFilmHits},
    {.names = "samples",
     .meaning = "number of samples of the pixel",
     .id = [](const AovPixel& pixel) { return pixel.film.samples; },
     .use = AovUse::asked},
    {.names = "steps",
     .meaning = "table look-ups or nodes visited, of all rays of a sample",
     .value = [](const AovPixel& pixel) { return glm::vec3(pixel.film.steps / taken(pixel)); },
     .kind = AovKind::work},
    {.names = "tests",
     .meaning = "triangle tests, of all rays of a sample",
     .value = [](const AovPixel& pixel) { return glm::vec3(pixel.film.tests / taken(pixel)); },
     .kind = AovKind::work},
};

bool isWrittenBy(const Aov& aov, const AovWriter writer) {
    return aov.writer == AovWriter::everyIntegrator || writer == AovWriter::pathTracer;
}

std::vector<Aov> rowsWhere(const auto& condition) {
    std::vector<Aov> rows;
    std::ranges::copy_if(kAovs, std::back_inserter(rows), condition);
    return rows;
}

[[noreturn]] void refuse(const std::string& line) { throw Error(ErrorKind::invalidArgument, line, {"aov"}); }

} // namespace

std::vector<std::string> Aov::channels() const {
    std::vector<std::string> all;
    std::istringstream words{std::string(names)};
    for (std::string word; words >> word;) {
        all.push_back(word);
    }
    return all;
}

std::string Aov::name() const {
    const std::vector<std::string> all = channels();
    const std::size_t dot = all.front().rfind('.');
    return all.size() == 1 ? all.front() : dot == std::string::npos ? "" : all.front().substr(0, dot);
}

std::span<const Aov> aovs() { return kAovs; }

std::vector<Aov> usualAovs(const AovWriter writer) {
    return rowsWhere([&](const Aov& aov) {
        return (aov.use == AovUse::always || aov.use == AovUse::usual) && isWrittenBy(aov, writer);
    });
}

std::vector<Aov> chooseAovs(const std::span<const std::string> names, const AovWriter writer) {
    if (names.size() == 1 && names.front() == "all") {
        return rowsWhere(
            [&](const Aov& aov) { return aov.use != AovUse::denoised && isWrittenBy(aov, writer); });
    }
    for (const std::string& name : names) {
        const auto* const found =
            std::ranges::find_if(kAovs, [&](const Aov& aov) { return !name.empty() && aov.name() == name; });
        if (found == std::end(kAovs) || found->use == AovUse::denoised) {
            std::vector<std::string> known;
            for (const Aov& aov : kAovs) {
                if (aov.use == AovUse::usual || aov.use == AovUse::asked) {
                    known.push_back(aov.name());
                }
            }
            refuse(fmt::format("'{}' is no channel; there are {}, and `all` alone", name,
                               fmt::join(known, " ")));
        }
        if (!isWrittenBy(*found, writer)) {
            refuse(fmt::format("the integrator primary does not know the channel {}", name));
        }
    }
    return rowsWhere([&](const Aov& aov) {
        return aov.use == AovUse::always || std::ranges::find(names, aov.name()) != names.end();
    });
}

const Aov& aovNamed(const std::string_view name) {
    return *std::ranges::find_if(kAovs, [&](const Aov& aov) { return aov.name() == name; });
}

std::vector<Aov> noisyAovs(const std::span<const Aov> chosen) {
    return rowsWhere([&](const Aov& aov) {
        return aov.use == AovUse::denoised && std::ranges::any_of(chosen, [&](const Aov& other) {
                   return kNoisy + other.channels().front() == aov.channels().front();
               });
    });
}

std::uint32_t filmPartsOf(const std::span<const Aov> chosen) {
    std::uint32_t parts = 0;
    for (const Aov& aov : chosen) {
        parts |= aov.filmParts;
    }
    return parts;
}

bool isSmall(const std::string_view channel) {
    return std::ranges::any_of(kAovs, [&](const Aov& aov) {
        const std::vector<std::string> channels = aov.channels();
        return aov.precision == AovPrecision::small && std::ranges::find(channels, channel) != channels.end();
    });
}

std::string aovText() {
    std::size_t width = 0;
    for (const Aov& aov : kAovs) {
        width = std::max(width, aov.names.size());
    }
    std::string text;
    for (const Aov& aov : kAovs) {
        text += fmt::format("{:{}}  {}{}{}\n", aov.names, width, aov.meaning,
                            aov.writer == AovWriter::pathTracer ? " (not by primary)" : "",
                            aov.use == AovUse::asked      ? " (if asked)"
                            : aov.use == AovUse::denoised ? " (if denoised)"
                                                          : "");
    }
    return text;
}

} // namespace metamarch
