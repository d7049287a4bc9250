// SPDX-License-Identifier: MIT
// Small image files in memory, byte by byte.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// Returns a PNG with `channels` samples per texel (1 grey, 2 grey and alpha, 3 RGB, 4 RGBA); row 0 is the top
// row. 16-bit samples are in the file's order, high byte first.
std::string pngFile(std::uint32_t width, std::uint32_t height, int channels,
                    const std::vector<unsigned char>& samples, int bitsPerSample = 8);

// Returns a single texel of this colour.
std::string onePixelPng(const std::vector<unsigned char>& rgba);

// Returns 8 x 8 texels of grey 200.
std::string jpegFile();

// Returns 4 x 4 texels: colour 200, 100, 50; alpha 128 in the upper half and 255 in the lower.
std::string webpFile();

// Returns a Radiance HDR with RGBE texels (mantissas of r, g, b, exponent + 128); row 0 is the top row.
std::string hdrFile(std::uint32_t width, std::uint32_t height, const std::vector<unsigned char>& rgbe);

std::string base64(const std::string& bytes);

} // namespace metamarch
