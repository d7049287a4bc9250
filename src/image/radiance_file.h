// SPDX-License-Identifier: MIT
// Radiance pictures (.hdr, .pic). OpenImageIO reads neither their older run-length coding nor XYZE, and
// leaves pictures of other orientations as they are stored.
#pragma once
#include "metamarch/image/image.h"

#include <filesystem>
#include <span>

namespace metamarch {

// Whether a file with these first bytes is a Radiance picture.
bool isRadiance(std::span<const unsigned char> bytes);

// Reads a Radiance picture of any orientation, flat or in either run-length coding, RGBE or XYZE, into linear
// R, G and B of Rec. 709. Values are as stored: EXPOSURE does not change them. Throws Error(inputRefused),
// naming `path`, for a header or pixels that are cut off or broken.
Image readRadiance(std::span<const unsigned char> bytes, const std::filesystem::path& path);

} // namespace metamarch
