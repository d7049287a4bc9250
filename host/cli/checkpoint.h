// SPDX-License-Identifier: MIT
// The checkpoint of `render`, and what it takes from one.
#pragma once
#include "metamarch/file/locked_file.h"
#include "metamarch/render/film_file.h"
#include "metamarch/render/path_run.h"

#include <optional>
#include <string>

namespace metamarch::cli {

class Checkpoint {
  public:
    // Takes the lock of the file. Throws Error(invalidArgument) where the file is there and `resumed` does
    // not name it: sums that nobody goes on with would be lost. Also throws what LockedFile throws.
    Checkpoint(const std::string& path, const std::string& resumed);

    // Writes the film file, with `run` as its only run. Throws Error(outputNotWritable); the old one then
    // stays.
    void write(const render::FilmFile& file, const render::FilmRun& run);

    void remove() { file_.remove(); }

  private:
    LockedFile file_;
};

// Takes the run from a file of sums, to go on with the samples of `range`. Throws Error(inputRefused) if it
// is of another picture than `wanted`, or has other samples; `wanted` has no runs.
render::FilmRun takeRun(render::FilmFile file, const std::string& path, const render::FilmFile& wanted,
                        const PixelRect& area, render::SampleRange range);

// Throws Error(inputRefused) by the name of what differs between the pictures of two files.
void requireSamePicture(const render::FilmFile& wanted, const std::string& wantedName,
                        const render::FilmFile& file, const std::string& name);

} // namespace metamarch::cli
