// SPDX-License-Identifier: MIT
// Sums of samples in a form that adds up to the same bits however a render is divided: in time (checkpoints),
// in samples and in areas (parts).
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/shared/film_data.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace metamarch::render {

// Sums of the samples firstSample, firstSample + 1, ... of each pixel of an area. The pixels themselves say
// how many samples they have. Copies share the film: a picture's sums may not fit into memory twice.
struct FilmSpan {
    FilmSpan(const std::uint32_t first, FilmData sums)
        : firstSample(first), film(std::make_shared<const FilmData>(std::move(sums))) {}

    std::uint32_t firstSample;
    std::shared_ptr<const FilmData> film; // null only after a move
};

// Spans of one area, by their first samples. Which sums a span may hold follows from the order in which the
// samples of a pixel are added (kBlockSamples): a span that begins with sample 0 holds whole blocks, or less
// than one; a span that begins with another block holds that block or its first samples; any other span holds
// one sample. The last span is the one that a render goes on with.
struct FilmRun {
    PixelRect area;
    std::vector<FilmSpan> spans;
    // What first samples see, one for each pixel. Empty unless the run begins with sample 0 and a channel of
    // the picture needs it.
    std::vector<SeenPoint> seen{};
};

// Sums over all samples of the pixels of an area, from spans that follow each other.
class FilmSum {
  public:
    // `parts` has bits kFilm....
    FilmSum(const PixelRect& area, std::uint32_t parts);

    // Adds a span that covers `rect`, which lies in the area. A pixel of it without samples counts for
    // nothing. Returns false, and has added only the pixels before `failed`, where a pixel does not begin
    // with the sample that is next, or holds sums that no span may hold.
    bool add(const PixelRect& rect, const FilmSpan& span);
    std::size_t failed() const { return failed_; } // index of the pixel in the span's film

    std::uint32_t samples(std::uint32_t x, std::uint32_t y) const; // of a pixel of the picture

    // Moves the sums out; the last block of a pixel may be incomplete.
    FilmData take();

  private:
    bool addPixelOf(std::size_t pixel, std::uint32_t firstSample, const FilmData& added, std::size_t from);

    PixelRect area_;
    FilmData blocks_;
    FilmData begun_; // less than a block of each pixel
    std::size_t failed_ = 0;
};

} // namespace metamarch::render
