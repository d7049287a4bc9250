// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/png_mend.h"

#include "metamarch/scene/texture/texture_decoder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <ranges>

namespace metamarch {
namespace {

constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kChunkOverhead = 12; // length, type, checksum

// The last chunk: no content.
constexpr std::array<unsigned char, kChunkOverhead> kEnd = {0,   0,   0,    0,    'I',  'E',
                                                            'N', 'D', 0xae, 0x42, 0x60, 0x82};

// The CRC's remainder for every byte, reflected (the specification's annex D).
constexpr std::array<std::uint32_t, 256> kRemainders = [] {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t remainder = byte;
        for (int bit = 0; bit < 8; ++bit) {
            remainder = (remainder & 1) != 0 ? 0xedb88320u ^ (remainder >> 1) : remainder >> 1;
        }
        remainders[byte] = remainder;
    }
    return remainders;
}();

std::uint32_t checkSum(std::span<const unsigned char> bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const unsigned char byte : bytes) {
        sum = kRemainders[(sum ^ byte) & 0xff] ^ (sum >> 8);
    }
    return ~sum;
}

std::uint32_t bigEndian(const unsigned char* bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
           std::uint32_t{bytes[3]};
}

// Whether the chunk is ancillary, which bit 5 of its type says, and no texel depends on it.
bool isDispensable(std::span<const unsigned char> chunk) {
    return (chunk[4] & 0x20) != 0 && std::memcmp(&chunk[4], "tRNS", 4) != 0;
}

} // namespace

MendedPng mendPng(std::span<const unsigned char> bytes) {
    MendedPng png;
    std::vector<unsigned char> kept(bytes.begin(), bytes.begin() + kSignatureSize);
    std::span<const unsigned char> rest = bytes.subspan(kSignatureSize);
    bool hasTexels = false;
    for (bool isLast = false; !isLast;) {
        if (hasTexels && rest.size() < kChunkOverhead &&
            std::ranges::equal(rest, kEnd | std::views::take(rest.size()))) {
            png.flaw = "has no end mark";
            kept.insert(kept.end(), kEnd.begin(), kEnd.end());
            break;
        }
        if (rest.size() < kChunkOverhead) {
            throw TextureFailure("is cut off");
        }
        const std::uint64_t length = bigEndian(rest.data());
        if (length > rest.size() - kChunkOverhead) {
            throw TextureFailure("is cut off");
        }
        const std::span<const unsigned char> chunk = rest.first(kChunkOverhead + length);
        if (checkSum(chunk.subspan(4, 4 + length)) == bigEndian(&chunk[8 + length])) {
            kept.insert(kept.end(), chunk.begin(), chunk.end());
        } else if (isDispensable(chunk)) {
            png.flaw = "has a wrong check sum in a chunk that holds no texels";
        } else {
            throw TextureFailure("has a wrong check sum");
        }
        hasTexels = hasTexels || std::memcmp(&chunk[4], "IDAT", 4) == 0;
        isLast = std::memcmp(&chunk[4], "IEND", 4) == 0;
        rest = rest.subspan(chunk.size());
    }
    if (!png.flaw.empty()) {
        png.bytes = std::move(kept);
    }
    return png;
}

} // namespace metamarch
