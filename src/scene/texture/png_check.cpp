// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/png_check.h"

#include "metamarch/scene/texture/texture_decoder.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace metamarch {
namespace {

constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kChunkOverhead = 12; // length, type, checksum

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

} // namespace

void checkPng(std::span<const unsigned char> bytes) {
    std::span<const unsigned char> rest = bytes.subspan(kSignatureSize);
    for (bool isLast = false; !isLast;) {
        if (rest.size() < kChunkOverhead) {
            throw TextureFailure("is cut off");
        }
        const std::uint64_t length = bigEndian(rest.data());
        if (length > rest.size() - kChunkOverhead) {
            throw TextureFailure("is cut off");
        }
        if (checkSum(rest.subspan(4, 4 + length)) != bigEndian(&rest[8 + length])) {
            throw TextureFailure("has a wrong check sum");
        }
        isLast = std::memcmp(&rest[4], "IEND", 4) == 0;
        rest = rest.subspan(kChunkOverhead + length);
    }
}

} // namespace metamarch
