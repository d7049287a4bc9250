// SPDX-License-Identifier: MIT
#include "scene/picture_file.h"

namespace metamarch {
namespace {

std::string bigEndian(std::uint32_t word) {
    return {static_cast<char>(word >> 24), static_cast<char>(word >> 16), static_cast<char>(word >> 8),
            static_cast<char>(word)};
}

std::uint32_t crc(const std::string& bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const char c : bytes) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum & 1) != 0 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
        }
    }
    return ~sum;
}

std::uint32_t adler(const std::string& bytes) {
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

std::string chunk(const std::string& type, const std::string& body) {
    return bigEndian(static_cast<std::uint32_t>(body.size())) + type + body + bigEndian(crc(type + body));
}

// Returns an uncompressed block in zlib's format, at most 65535 bytes.
std::string stored(const std::string& bytes) {
    const auto size = static_cast<std::uint16_t>(bytes.size());
    const auto low = [](std::uint16_t word) { return static_cast<char>(word & 0xff); };
    const auto high = [](std::uint16_t word) { return static_cast<char>(word >> 8); };
    const auto inverse = static_cast<std::uint16_t>(~size);
    return std::string{'\x78', '\x01', '\x01', low(size), high(size), low(inverse), high(inverse)} + bytes +
           bigEndian(adler(bytes));
}

std::string fromBase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> count);
        }
    }
    return bytes;
}

} // namespace

std::string pngFile(std::uint32_t width, std::uint32_t height, int channels,
                    const std::vector<unsigned char>& samples, int bitsPerSample) {
    constexpr char kColorTypes[] = {0, 0, 4, 2, 6};
    std::string header = bigEndian(width) + bigEndian(height);
    header += {static_cast<char>(bitsPerSample), kColorTypes[channels], 0, 0, 0};
    const std::size_t row = samples.size() / height;
    std::string rows;
    for (std::size_t y = 0; y < height; ++y) {
        rows += '\0' + std::string(samples.begin() + static_cast<std::ptrdiff_t>(y * row),
                                   samples.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    }
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

std::string onePixelPng(const std::vector<unsigned char>& rgba) { return pngFile(1, 1, 4, rgba); }

std::string jpegFile() {
    return fromBase64(
        "/9j/4AAQSkZJRgABAQAAAQABAAD/4QAWRXhpZgAASUkqAAgAAAAAAAAAAAD/2wBDAAEBAQEBAQEBAQEBAQEBAQIBAQEBAQIBAQEC"
        "AgICAgICAgIDAwQDAwMDAwICAwQDAwQEBAQEAgMFBQQEBQQEBAT/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAEC"
        "AwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRol"
        "JicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2"
        "t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/AP6QK//Z");
}

std::string webpFile() { return fromBase64("UklGRiIAAABXRUJQVlA4TBUAAAAvA8AAEA8wZIM8Mv8DjAfMQ0T/gwEA"); }

std::string hdrFile(std::uint32_t width, std::uint32_t height, const std::vector<unsigned char>& rgbe) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n" + std::string(rgbe.begin(), rgbe.end());
}

std::string base64(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k) {
            bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
        }
    }
    return text;
}

} // namespace metamarch
