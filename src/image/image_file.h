// SPDX-License-Identifier: MIT
// Pictures to and from files. Every failure is an Error of one line that names the file.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/image/tone_mapping.h"

#include <filesystem>

namespace metamarch {

// Writes by the ending of the name; the file appears only when it is complete (see OutputFile).
//   .exr  every channel under its own name, 32-bit float, zip-compressed, linear whatever `toneMapping` says;
//         the attributes in the header.
//   .png  the channels R, G, B and, where there is one, A, tone-mapped to 8-bit sRGB.
// Error(invalidArgument): another ending, or a PNG of a picture without R, G and B.
// Error(outputNotWritable): no such folder, no permission, disk full.
void writeImage(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping = {});

// Throws what writeImage(…, path) would throw for reasons known beforehand: to be called before an expensive
// render.
void checkWritable(const std::filesystem::path& path);

// Reads any single-part picture OpenImageIO knows. Values are as stored, without a conversion of colours: EXR
// keeps every bit, 8-bit formats become multiples of 1/255. EXR stores its channels sorted by name, so their
// order may differ from the one written: find them by name. Of the header only attributes of text are kept.
// Error(inputRefused): missing, unreadable, truncated, deep or of several parts.
Image readImage(const std::filesystem::path& path);

} // namespace metamarch
