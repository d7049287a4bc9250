// SPDX-License-Identifier: MIT
// Writes the parts of a picture into an OutputFile, through OpenImageIO.
#pragma once
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace metamarch {

// `pixelsOf` returns the pixels of a part as its spec describes them: row by row from the top, channels
// interleaved. It is called once for each part, in their order. Throws Error(outputNotWritable); the file
// then stays as it was.
void writeParts(const std::filesystem::path& path, const char* format, std::span<const OIIO::ImageSpec> parts,
                const std::function<std::vector<std::byte>(std::size_t part)>& pixelsOf);

} // namespace metamarch
