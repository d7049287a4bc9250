// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/environment.h"

#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"
#include "metamarch/shared/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

// Returns the indices of the channels of red, green and blue; for a grey image all are the same.
std::array<std::size_t, 3> colorChannels(const Image& image, const std::filesystem::path& file) {
    const auto red = image.findChannel("R");
    const auto green = image.findChannel("G");
    const auto blue = image.findChannel("B");
    if (red && green && blue) {
        return {*red, *green, *blue};
    }
    const auto grey = image.findChannel("Y");
    if (grey || image.channels.size() == 1) {
        return {grey.value_or(0), grey.value_or(0), grey.value_or(0)};
    }
    throw Error(ErrorKind::inputRefused,
                fmt::format("{}: an environment has channels R, G and B, or Y", file.string()));
}

bool isEncoded(const Image& image) {
    return std::ranges::find(image.attributes, std::pair<std::string, ImageAttribute>(
                                                   "oiio:ColorSpace", "sRGB")) != image.attributes.end();
}

// The inverse of IEC 61966-2-1's transfer curve.
float decoded(const double value) {
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

[[noreturn]] void refuseTexel(const Environment& environment, std::size_t index,
                              const std::filesystem::path& file, const std::string& reason) {
    const glm::vec3& texel = environment.texels[index];
    throw Error(ErrorKind::inputRefused,
                fmt::format("{}: texel {},{} has a radiance of {} {} {}; {}", file.string(),
                            index % environment.width, index / environment.width, texel.r, texel.g, texel.b,
                            reason));
}

// Returns true if a colour is visible light that Rec. 709's primaries cannot mix. The most negative channel
// belongs to monochromatic cyan, where it is about as far below 0 as the largest channel is above.
bool isOutsideGamut(const glm::vec3& texel) {
    return luminance(texel) > 0.0f && -smallest(texel) <= largest(texel);
}

// Returns true if scaling of the image can have made a texel this negative beside brighter light. Lanczos's
// filter with three lobes has the deepest undershoot in use: a point of light between two texels leaves 0.61
// in each of them and -0.135 in the next ones.
bool isUndershoot(const Environment& environment, std::size_t index) {
    constexpr int kPixelReach = 3;
    constexpr float kDepth = 0.25f;
    const int width = static_cast<int>(environment.width);
    const int height = static_cast<int>(environment.height);
    const int column = static_cast<int>(index % environment.width);
    const int row = static_cast<int>(index / environment.width);
    glm::vec3 brightest(0.0f); // per channel
    for (int y = std::max(row - kPixelReach, 0); y <= std::min(row + kPixelReach, height - 1); ++y) {
        for (int x = column - kPixelReach; x <= column + kPixelReach; ++x) {
            const int wrapped = (x % width + width) % width;
            brightest =
                glm::max(brightest, environment.texels[static_cast<std::size_t>(y) * environment.width +
                                                       static_cast<std::size_t>(wrapped)]);
        }
    }
    return glm::all(glm::greaterThanEqual(environment.texels[index], -kDepth * brightest));
}

// Sets negative channels to 0 where they stand for light; refuses all others.
void repairNegativeLight(Environment& environment, const std::filesystem::path& file) {
    std::vector<std::size_t> repaired;
    std::size_t outsideGamut = 0;
    for (std::size_t i = 0; i < environment.texels.size(); ++i) {
        const glm::vec3& texel = environment.texels[i];
        if (smallest(texel) >= 0.0f) {
            continue;
        }
        if (isOutsideGamut(texel)) {
            ++outsideGamut;
        } else if (!isUndershoot(environment, i)) {
            refuseTexel(environment, i, file,
                        "light is not negative, but in colours outside Rec. 709 and beside light four times "
                        "as bright");
        }
        repaired.push_back(i);
    }
    // Change the texels only now: each was judged by its neighbours' original values.
    for (const std::size_t i : repaired) {
        environment.texels[i] = glm::max(environment.texels[i], 0.0f);
    }
    if (!repaired.empty()) {
        environment.warnings.push_back(
            fmt::format("{}: channels below 0 are taken for 0; texels that have them: {} ({} colours outside "
                        "Rec. 709, {} undershoots of a filter beside brighter light)",
                        file.string(), repaired.size(), outsideGamut, repaired.size() - outsideGamut));
    }
}

// The sun in half floats: what is brighter than 65504 is stored as infinite.
void repairInfiniteLight(Environment& environment, const std::filesystem::path& file,
                         std::optional<float> maximum) {
    constexpr float kLargestHalf = 65504.0f;
    float brightest = kLargestHalf;
    for (const glm::vec3& texel : environment.texels) {
        for (int channel = 0; channel < 3; ++channel) {
            brightest = std::isfinite(texel[channel]) ? std::max(brightest, texel[channel]) : brightest;
        }
    }
    const float limit = maximum.value_or(brightest);
    std::size_t infinite = 0;
    std::size_t noNumber = 0;
    for (glm::vec3& texel : environment.texels) {
        bool hasInfinite = false;
        bool hasNoNumber = false;
        for (int channel = 0; channel < 3; ++channel) {
            float& value = texel[channel];
            if (std::isnan(value)) {
                hasNoNumber = true;
                value = 0.0f;
            } else if (std::isinf(value) && value > 0.0f) {
                hasInfinite = true;
                value = limit;
            }
        }
        infinite += hasInfinite ? 1 : 0;
        noNumber += hasNoNumber ? 1 : 0;
    }
    if (infinite > 0) {
        environment.warnings.push_back(
            fmt::format("{}: infinite light is taken for {}; texels that have it: {}{}", file.string(), limit,
                        infinite, maximum ? "" : "; a maximum for the map's light dims them"));
    }
    if (noNumber > 0) {
        environment.warnings.push_back(fmt::format(
            "{}: light that is no number is taken for 0; texels that have it: {}", file.string(), noNumber));
    }
}

// Keeps the colours of what is too bright.
void dimTo(Environment& environment, float maximum) {
    for (glm::vec3& texel : environment.texels) {
        if (const float brightest = largest(texel); brightest > maximum) {
            texel = glm::min(texel * (maximum / brightest), maximum);
        }
    }
}

} // namespace

Environment loadEnvironment(const std::filesystem::path& file, const std::optional<float> maximum) {
    const Image image = readImage(file);
    const std::array<std::size_t, 3> channels = colorChannels(image, file);
    const bool encoded = isEncoded(image);
    Environment environment;
    environment.width = static_cast<std::uint32_t>(image.width);
    environment.height = static_cast<std::uint32_t>(image.height);
    environment.texels.reserve(image.pixelCount());
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        glm::vec3 texel;
        for (int c = 0; c < 3; ++c) {
            const float value =
                image.pixels[i * image.channels.size() + channels[static_cast<std::size_t>(c)]];
            texel[c] = encoded ? decoded(value) : value;
        }
        environment.texels.push_back(texel);
    }
    repairInfiniteLight(environment, file, maximum);
    repairNegativeLight(environment, file);
    if (maximum) {
        dimTo(environment, *maximum);
    }
    return environment;
}

} // namespace metamarch
