// SPDX-License-Identifier: MIT
// Cryptomatte: how much of each pixel is of which object, so that a compositor can cut any of them out.
// J. Friedman, A. C. Jones, "Fully Automatic ID Mattes with Support for Motion Blur and Transparency", 2015;
// Psyop's "Cryptomatte Specification" 1.2.0 says how an EXR stores it.
#pragma once
#include "metamarch/image/image.h"
#include "metamarch/shared/film_data.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

// The objects with the largest parts of a pixel that a picture keeps.
inline constexpr std::size_t kCryptomatteRanks = 6;

// What is told apart: objects, materials or assets.
struct CryptomatteLevel {
    std::string layer;                    // "CryptoObject"
    std::vector<std::string> nameOfGroup; // FilmData::hits has groups; equal names are one object

    bool operator==(const CryptomatteLevel&) const = default;
};

// MurmurHash3_x86_32 with seed 0.
std::uint32_t murmurHash3(std::string_view text);

// The id that stands for a name: its hash, of which one bit is changed if no float of these bits is a normal
// number.
std::uint32_t cryptomatteId(std::string_view name);

// Adds the channels of a level, LAYER00.R to LAYER02.A, and the attributes that describe them. The film must
// have hits, one list for each pixel of the picture.
void addCryptomatte(const CryptomatteLevel& level, const FilmData& film, Image& image);

// Whether a channel is one of Cryptomatte. No bit of it may change.
bool isOfCryptomatte(std::string_view channel);

} // namespace metamarch
