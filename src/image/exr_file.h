// SPDX-License-Identifier: MIT
// Writes OpenEXR pictures.
#pragma once
#include "metamarch/image/image.h"

#include <filesystem>

namespace metamarch {

enum class ExrCompression { zip, zips, piz, dwaa, none }; // only dwaa loses something

struct ExrStorage {
    // Floats of 16 bits for colours, coverage and normals. All others keep 32 bits.
    bool isHalf = false;
    ExrCompression compression = ExrCompression::zip;
    float dwaaLevel = 45.0f;  // OpenEXR's own default; larger: smaller files, larger errors
    bool isTiled = false;     // in tiles of 64 x 64 pixels, otherwise in scan lines
    bool isMultipart = false; // one part for each layer

    bool operator==(const ExrStorage&) const = default;
};

// Throws Error(invalidArgument): a lossy method and channels that must stay exact cannot be in one part.
[[noreturn]] void refuseLossyIds();

// Writes all channels under their names, linear, with the attributes in the header. The bytes follow from the
// arguments alone. Throws as writeImage does.
void writeExr(const Image& image, const std::filesystem::path& path, const ExrStorage& storage);

} // namespace metamarch
