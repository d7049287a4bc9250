// SPDX-License-Identifier: MIT
// Files of sums: the checkpoint of a render that is not complete, and parts of a picture that are put
// together later. They hold the film as it is, bit for bit, because no picture does: a picture has means, of
// all samples together.
#pragma once
#include "metamarch/image/cryptomatte.h"
#include "metamarch/render/film_run.h"

#include <cstddef>
#include <filesystem>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace metamarch::render {

// What a picture follows from besides its samples: names and values, as text. Sums add up only where all
// facts agree.
using FilmFacts = std::vector<std::pair<std::string, std::string>>;

// Returns the name of the first fact with another value in `there`, or that only one of them has.
std::optional<std::string> differingFact(const FilmFacts& here, const FilmFacts& there);

// "" where there is no such fact.
std::string factNamed(const FilmFacts& facts, std::string_view name);

struct FilmFile {
    FilmFacts facts;
    std::string sceneFile;   // as the user spelled it; no fact, since machines have files in different places
    std::uint32_t width = 0; // of the whole picture
    std::uint32_t height = 0;
    std::vector<CryptomatteLevel> cryptomatte; // the names of the groups that the films' hits have
    std::vector<FilmRun> runs;
};

// The bytes of a file, as pieces that follow each other. They refer to the films.
class FilmFileBytes {
  public:
    // `runs` stand in place of the file's own.
    FilmFileBytes(const FilmFile& file, std::span<const FilmRun> runs);

    std::span<const std::span<const std::byte>> pieces() const { return pieces_; }

  private:
    std::vector<std::byte> head_;
    std::list<std::vector<std::uint32_t>> hitWords_; // of each film; a list, because pieces_ refer to them
    std::vector<std::span<const std::byte>> pieces_;
};

// Writes an OutputFile; a checkpoint is a LockedFile. Throws Error(outputNotWritable).
void writeFilmFile(const FilmFile& file, std::span<const FilmRun> runs, const std::filesystem::path& path);

// Throws Error(inputRefused) for a file that is missing, cut off, damaged or none of these, before it takes
// memory for what the file only claims to hold.
FilmFile readFilmFile(const std::filesystem::path& path);

} // namespace metamarch::render
