// SPDX-License-Identifier: MIT
// Writes pictures to files and reads them. Every failure is an Error of one line that names the file.
#pragma once
#include "metamarch/image/exr_file.h"
#include "metamarch/image/image.h"
#include "metamarch/image/tone_mapping.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace metamarch {

enum class PictureFormat { exr, png, jpeg, webp, tiff };

inline constexpr std::pair<std::string_view, PictureFormat> kPictureFormats[] = {
    {"exr", PictureFormat::exr},
    {"png", PictureFormat::png},
    {"jpeg", PictureFormat::jpeg},
    {"webp", PictureFormat::webp},
    {"tiff", PictureFormat::tiff}};

// How a picture is stored.
struct PictureStorage {
    std::optional<PictureFormat> format{}; // none: by the ending of the name
    std::uint32_t bits = 8;                // of a colour in PNG and TIFF: 8 or 16
    ExrStorage exr{};
};

// Returns the format of `storage`, or the one of the name's ending, in small or capital letters. For a
// device, a pipe or a standard stream whose name has no ending it is EXR. Throws Error(invalidArgument) for
// another ending, for one of another format than that of `storage`, and where the format lacks what `storage`
// wants.
PictureFormat pictureFormatOf(const std::filesystem::path& path, const PictureStorage& storage = {});

// The attribute that says when a picture was made, as text: "2026:01:31 23:59:59". Without it the bytes of a
// file follow from the picture alone.
inline constexpr const char* kDateTime = "DateTime";

// Writes a picture. The file appears only when it is complete (see OutputFile). The format is
// pictureFormatOf(path, storage). An EXR is what writeExr writes; `toneMapping` is for the others, which have
// the channels R, G, B and, if there is one, A, tone-mapped to sRGB. JPEG has no A.
// Throws what pictureFormatOf throws, and Error(invalidArgument) for a picture without R, G and B that is not
// an EXR. Throws Error(outputNotWritable) if the folder does not exist, permission is missing or the disk is
// full.
void writeImage(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping = {},
                const PictureStorage& storage = {});

// Returns four bytes a pixel: R, G, B, tone-mapped to sRGB, and A, or 255 where the picture has no A. A PNG
// has these bytes. Throws Error(invalidArgument) for a picture without R, G and B.
std::vector<std::uint8_t> rgba8Of(const Image& image, const ToneMapping& toneMapping = {});

// Throws what writeImage would throw for reasons that are known beforehand. Call it before an expensive
// render.
void checkWritable(const std::filesystem::path& path, const PictureStorage& storage = {});

// Reads any picture that OpenImageIO supports, and Radiance pictures of every kind. Parts become one picture
// if they have the same size and no channel twice. A picture whose pixels fill only a part of its display
// window gets 0 around them. Returns the values as they are stored, without a conversion of colours: EXR
// keeps every bit, and 8-bit formats become multiples of 1/255. EXR stores channels sorted by name, so their
// order may differ from that of the picture that was written; find them by name. Keeps only those attributes
// of the header that are text. Throws Error(inputRefused) if the file is missing, unreadable, truncated or
// deep, or has parts that do not fit together.
Image readImage(const std::filesystem::path& path);

// Limits the threads of the libraries that read and write pictures; at least 1. Their default is one for each
// processor.
void setImageThreads(int threads);

// In a forked process the libraries lack the threads of its parent: from now on the calling thread works
// alone.
void forgetImageThreads();

} // namespace metamarch
