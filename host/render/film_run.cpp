// SPDX-License-Identifier: MIT
#include "metamarch/render/film_run.h"

namespace metamarch::render {
namespace {

void clearAt(FilmData& film, const std::size_t pixel) {
    film.pixels[pixel] = emptyPixel();
    if (!film.light.empty()) {
        film.light[pixel] = noLight();
    }
    if (!film.hits.empty()) {
        film.hits[pixel].clear();
    }
}

} // namespace

FilmSum::FilmSum(const PixelRect& area, const std::uint32_t parts)
    : area_(area), blocks_(area.pixelCount(), parts), begun_(area.pixelCount(), parts) {}

bool FilmSum::addPixelOf(const std::size_t pixel, const std::uint32_t firstSample, const FilmData& added,
                         const std::size_t from) {
    const std::uint32_t count = added.pixels[from].samples;
    if (count == 0) {
        return true;
    }
    const std::uint32_t begun = begun_.pixels[pixel].samples;
    if (blocks_.pixels[pixel].samples + begun != firstSample) {
        return false;
    }
    const bool isWhole = firstSample == 0 ? count % kBlockSamples == 0 : count == kBlockSamples;
    if (firstSample % kBlockSamples == 0 && isWhole) {
        addAt(blocks_, pixel, added, from);
        return true;
    }
    if (count != 1 && !(begun == 0 && count < kBlockSamples && firstSample % kBlockSamples == 0)) {
        return false;
    }
    addAt(begun_, pixel, added, from);
    if (begun_.pixels[pixel].samples == kBlockSamples) {
        addAt(blocks_, pixel, begun_, pixel);
        clearAt(begun_, pixel);
    }
    return true;
}

bool FilmSum::add(const PixelRect& rect, const FilmSpan& span) {
    for (failed_ = 0; failed_ < span.film->pixels.size(); ++failed_) {
        const std::size_t x = rect.left - area_.left + failed_ % rect.width();
        const std::size_t y = rect.top - area_.top + failed_ / rect.width();
        if (!addPixelOf(y * area_.width() + x, span.firstSample, *span.film, failed_)) {
            return false;
        }
    }
    return true;
}

std::uint32_t FilmSum::samples(const std::uint32_t x, const std::uint32_t y) const {
    const std::size_t pixel = std::size_t{y - area_.top} * area_.width() + (x - area_.left);
    return blocks_.pixels[pixel].samples + begun_.pixels[pixel].samples;
}

FilmData FilmSum::take() {
    addBlock(blocks_, begun_);
    return std::move(blocks_);
}

} // namespace metamarch::render
