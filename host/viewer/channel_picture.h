// SPDX-License-Identifier: MIT
// A channel of the film as the window shows it.
#pragma once
#include "metamarch/image/aov.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/shared/film_data.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch::viewer {

// Returns the rows of the table of channels that follow from a window's film and the scene.
std::vector<Aov> shownChannels();

// Returns packed pixels (shared/packed_pixel.h), in the order of the film's. Radiance and albedo are mapped
// by `tone`; directions from -1 to 1 are colours from 0 to 1; other numbers are a heat map from their least
// to their greatest finite value; each whole number has a colour of its own, and kNoId is black. `seen` is as
// for filmImage.
std::vector<std::uint32_t> channelPixels(const Aov& channel, const FilmData& film,
                                         std::span<const SeenPoint> seen, const ToneMapping& tone);

} // namespace metamarch::viewer
