// SPDX-License-Identifier: MIT
// Refuses a command line on which one file is written twice, or both read and written.
#pragma once
#include "metamarch/scene/scene.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace metamarch::cli {

// A file with the option or argument that names it: "--env", "SCENE".
struct NamedFile {
    std::string option;
    std::filesystem::path path; // empty: not given
};

// Throws Error(invalidArgument) where an output is the same file as an input or as an output before it. Links
// are followed. Throws Error(outputNotWritable) where an output cannot be written.
void checkOutputsDiffer(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

// Returns the files that the scene's own file names: buffers, textures, libraries of materials.
std::vector<NamedFile> companionsOf(const Scene& scene);

} // namespace metamarch::cli
