// SPDX-License-Identifier: MIT
// What `render` and `merge` share.
#pragma once
#include "metamarch/render/film_file.h"

#include <cstdint>
#include <string>

namespace metamarch::cli {

// Writes the picture that `render` would have written in one go. `file` says how it was rendered, `name` is
// its name for messages, and `film` covers the whole picture with `samples` samples of each pixel.
void writeMerged(const render::FilmFile& file, const std::string& name, FilmData film, std::uint32_t samples,
                 const std::string& output);

} // namespace metamarch::cli
