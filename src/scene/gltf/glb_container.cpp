// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/glb_container.h"

#include <cstdint>
#include <cstring>

namespace metamarch {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;     // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a; // "JSON"
constexpr std::uint32_t kBinChunk = 0x004e4942;  // "BIN"
constexpr std::size_t kLengthOffset = 8;
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

std::uint32_t loadWord(const std::vector<unsigned char>& bytes, std::size_t offset) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

} // namespace

bool isGlb(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && loadWord(bytes, 0) == kMagic;
}

GlbChunks glbChunks(const InputFile& file, const std::vector<unsigned char>& bytes) {
    if (bytes.size() < kHeaderSize + kChunkHeaderSize) {
        file.refuse("GLB header is cut off");
    }
    if (const std::uint32_t version = loadWord(bytes, 4); version != 2) {
        file.refuse("GLB version " + std::to_string(version) + " is not supported, version 2 is");
    }
    const std::uint64_t length = loadWord(bytes, kLengthOffset);
    if (length > bytes.size()) {
        file.refuse("GLB length " + std::to_string(length) + " is more than the file's " +
                    std::to_string(bytes.size()) + " bytes");
    }
    if (length < kHeaderSize + kChunkHeaderSize) {
        file.refuse("GLB length " + std::to_string(length) + " leaves no room for a chunk");
    }

    const std::uint64_t jsonLength = loadWord(bytes, kHeaderSize);
    if (loadWord(bytes, kHeaderSize + 4) != kJsonChunk) {
        file.refuse("GLB chunk 0 is not JSON");
    }
    const ByteRange json{kHeaderSize + kChunkHeaderSize, kHeaderSize + kChunkHeaderSize + jsonLength};
    if (json.end > length) {
        file.refuse("GLB chunk 0 of " + std::to_string(jsonLength) + " bytes reaches past the GLB length " +
                    std::to_string(length));
    }
    if (json.end == length) {
        return {json, {}};
    }

    if (length - json.end < kChunkHeaderSize) {
        file.refuse("GLB chunk 1 header is cut off");
    }
    const std::uint64_t binaryLength = loadWord(bytes, json.end);
    if (binaryLength > length - json.end - kChunkHeaderSize) {
        file.refuse("GLB chunk 1 of " + std::to_string(binaryLength) + " bytes reaches past the GLB length " +
                    std::to_string(length));
    }
    // A second chunk of another type belongs to an extension that is not read.
    if (loadWord(bytes, json.end + 4) != kBinChunk) {
        return {json, {}};
    }
    const std::size_t begin = json.end + kChunkHeaderSize;
    return {json, {begin, begin + binaryLength}};
}

} // namespace metamarch
