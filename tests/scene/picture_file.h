// Small pictures in memory, byte by byte.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// A PNG of `channels` samples per texel (1 grey, 2 grey and alpha, 3 RGB, 4 RGBA), row 0 on top. With samples
// of 16 bits they lie in the file's order, high byte first.
std::string pngFile(std::uint32_t width, std::uint32_t height, int channels,
                    const std::vector<unsigned char>& samples, int bitsPerSample = 8);

// One texel of this colour.
std::string onePixelPng(std::vector<unsigned char> rgba);

// 8 x 8, grey 200.
std::string jpegFile();

// 4 x 4: colour 200, 100, 50, alpha 128 in the upper half and 255 in the lower.
std::string webpFile();

// A Radiance HDR of RGBE texels (mantissas of r, g, b, exponent + 128), row 0 on top.
std::string hdrFile(std::uint32_t width, std::uint32_t height, const std::vector<unsigned char>& rgbe);

std::string base64(const std::string& bytes);

} // namespace metamarch
