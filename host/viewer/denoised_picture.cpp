// SPDX-License-Identifier: MIT
#include "metamarch/viewer/denoised_picture.h"

#include "metamarch/render/picture.h"
#include "metamarch/shared/backdrop.h"

#include <chrono>
#include <utility>

namespace metamarch::viewer {

std::vector<DenoisedPicture::Pixel> DenoisedPicture::denoise(const Denoiser& denoiser, FilmData film,
                                                             const glm::uvec2 size) {
    render::RenderResult result;
    result.settings.channels = chooseAovs({}, AovWriter::pathTracer);
    result.size = size;
    result.area = {0, 0, size.x, size.y};
    result.film = std::move(film);
    const std::vector<glm::vec3> colors = colorsIn(render::imageOf(result, &denoiser), "R");
    std::vector<Pixel> pixels;
    pixels.reserve(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        pixels.push_back({colors[i], coverage(result.film.pixels[i])});
    }
    return pixels;
}

void DenoisedPicture::clear() {
    isOfOtherPicture = work.valid();
    done.clear();
    samplesBegun = 0.0;
}

bool DenoisedPicture::wants(const double samples, const bool isLast) const {
    return !work.valid() && samples >= 1.0 &&
           (samples >= 2.0 * samplesBegun || (isLast && samples > samplesBegun));
}

void DenoisedPicture::begin(const Denoiser& denoiser, FilmData film, const glm::uvec2 size,
                            const double samples) {
    samplesBegun = samples;
    work = std::async(std::launch::async, denoise, std::cref(denoiser), std::move(film), size);
}

bool DenoisedPicture::take() {
    if (!work.valid() || work.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return false;
    }
    const bool isWanted = !std::exchange(isOfOtherPicture, false);
    std::vector<Pixel> result = work.get();
    if (!isWanted) {
        return false;
    }
    done = std::move(result);
    return true;
}

std::vector<std::uint32_t> DenoisedPicture::pixels(const ToneMapping& tone) const {
    std::vector<std::uint32_t> packed;
    packed.reserve(done.size());
    for (const Pixel& pixel : done) {
        packed.push_back(withCoverage(packedLinear(toneMapped(tone, pixel.radiance)), pixel.coverage));
    }
    return packed;
}

} // namespace metamarch::viewer
