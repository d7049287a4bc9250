// SPDX-License-Identifier: MIT
// What `render` and `merge` share.
#pragma once
#include "metamarch/render/film_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch::cli {

// Writes the picture that `render` would have written in one go. `file` says how it was rendered, `name` is
// its name for messages, and `film` covers the whole picture with `samples` samples of each pixel. `seen` is
// what their first samples see, or empty if no channel needs it. Throws Error(inputRefused) for a film that
// lacks what the channels need.
void writeMerged(const render::FilmFile& file, const std::string& name, FilmData film,
                 std::vector<SeenPoint> seen, std::uint32_t samples, const std::string& output);

} // namespace metamarch::cli
