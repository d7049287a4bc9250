// SPDX-License-Identifier: MIT
// Writes pictures to files and reads them. Every failure is an Error of one line that names the file.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/image/tone_mapping.h"

#include <filesystem>

namespace metamarch {

enum class PictureFormat { exr, png };

// Returns the format by the ending of the name, in small or capital letters; EXR for a device, a pipe or a
// standard stream whose name has no ending. Throws Error(invalidArgument) for another ending.
PictureFormat pictureFormatOf(const std::filesystem::path& path);

// The attribute that says when a picture was made, as text: "2026:01:31 23:59:59". Without it the bytes of a
// file follow from the picture alone.
inline constexpr const char* kDateTime = "DateTime";

// Writes a picture. The file appears only when it is complete (see OutputFile). The format is
// pictureFormatOf(path):
//   .exr  all channels under their names, 32-bit float, linear, zip-compressed, with the attributes in the
//         header. `toneMapping` is ignored.
//   .png  the channels R, G, B and, if there is one, A, tone-mapped to 8-bit sRGB.
// Throws Error(invalidArgument) for another ending and for a PNG of a picture without R, G and B. Throws
// Error(outputNotWritable) if the folder does not exist, permission is missing or the disk is full.
void writeImage(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping = {});

// Throws what writeImage would throw for reasons that are known beforehand. Call it before an expensive
// render.
void checkWritable(const std::filesystem::path& path);

// Reads any picture with a single part that OpenImageIO supports, and Radiance pictures of every kind. A
// picture whose pixels fill only a part of its display window gets 0 around them. Returns the values as they
// are stored, without a conversion of colours: EXR keeps every bit, and 8-bit formats become multiples of
// 1/255. EXR stores channels sorted by name, so their order may differ from that of the picture that was
// written; find them by name. Keeps only those attributes of the header that are text. Throws
// Error(inputRefused) if the file is missing, unreadable, truncated, deep or has several parts.
Image readImage(const std::filesystem::path& path);

// Limits the threads of the libraries that read and write pictures; at least 1. Their default is one for each
// processor.
void setImageThreads(int threads);

} // namespace metamarch
