// SPDX-License-Identifier: MIT
#include "metamarch/viewer/denoised_picture.h"

#include "metamarch/render/picture.h"
#include "metamarch/shared/packed_pixel.h"

#include <chrono>
#include <utility>

namespace metamarch::viewer {
namespace {

std::vector<glm::vec3> filtered(const Denoiser& denoiser, FilmData film, const glm::uvec2 size) {
    render::RenderResult result;
    result.settings.channels = chooseAovs({}, AovWriter::pathTracer);
    result.size = size;
    result.area = {0, 0, size.x, size.y};
    result.film = std::move(film);
    return colorsIn(render::imageOf(result, &denoiser), "R");
}

} // namespace

void DenoisedPicture::clear() {
    isOfOtherPicture = work.valid();
    radiance.clear();
    samplesBegun = 0.0;
}

bool DenoisedPicture::wants(const double samples, const bool isLast) const {
    return !work.valid() && samples >= 1.0 &&
           (samples >= 2.0 * samplesBegun || (isLast && samples > samplesBegun));
}

void DenoisedPicture::begin(const Denoiser& denoiser, FilmData film, const glm::uvec2 size,
                            const double samples) {
    samplesBegun = samples;
    work = std::async(std::launch::async, filtered, std::cref(denoiser), std::move(film), size);
}

bool DenoisedPicture::take() {
    if (!work.valid() || work.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return false;
    }
    const bool isWanted = !std::exchange(isOfOtherPicture, false);
    std::vector<glm::vec3> result = work.get();
    if (!isWanted) {
        return false;
    }
    radiance = std::move(result);
    return true;
}

std::vector<std::uint32_t> DenoisedPicture::pixels(const ToneMapping& tone) const {
    std::vector<std::uint32_t> packed;
    packed.reserve(radiance.size());
    for (const glm::vec3& color : radiance) {
        packed.push_back(packedLinear(toneMapped(tone, color)));
    }
    return packed;
}

} // namespace metamarch::viewer
