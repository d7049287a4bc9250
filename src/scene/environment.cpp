#include "scene/environment.h"

#include "error.h"
#include "image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace metamarch {
namespace {

// Where red, green and blue lie; grey is all of them.
std::array<std::size_t, 3> colorChannels(const Image& image, const std::filesystem::path& file) {
    const auto red = image.findChannel("R");
    const auto green = image.findChannel("G");
    const auto blue = image.findChannel("B");
    if (red && green && blue)
        return {*red, *green, *blue};
    const auto grey = image.findChannel("Y");
    if (grey || image.channels.size() == 1)
        return {grey.value_or(0), grey.value_or(0), grey.value_or(0)};
    throw Error(ExitCode::sceneRefused,
                fmt::format("{}: an environment has channels R, G and B, or Y", file.string()));
}

bool isEncoded(const Image& image) {
    return std::ranges::find(image.attributes, std::pair<std::string, std::string>(
                                                   "oiio:ColorSpace", "sRGB")) != image.attributes.end();
}

// The inverse of IEC 61966-2-1's curve.
float decoded(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

void checkTexel(const glm::vec3& texel, std::size_t index, const Image& image,
                const std::filesystem::path& file) {
    for (int channel = 0; channel < 3; ++channel) {
        if (!(texel[channel] >= 0.0f && std::isfinite(texel[channel])))
            throw Error(
                ExitCode::sceneRefused,
                fmt::format("{}: texel {},{} has a radiance of {}; an environment's are finite and at "
                            "least 0",
                            file.string(), index % static_cast<std::size_t>(image.width),
                            index / static_cast<std::size_t>(image.width), texel[channel]));
    }
}

} // namespace

Environment loadEnvironment(const std::filesystem::path& file) {
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
        checkTexel(texel, i, image, file);
        environment.texels.push_back(texel);
    }
    return environment;
}

} // namespace metamarch
