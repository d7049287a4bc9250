// SPDX-License-Identifier: MIT
// Images of every format, intact and broken.
#include "metamarch/scene/texture/texture_decoder.h"
#include "scene/picture_file.h"

#include <gtest/gtest.h>

namespace metamarch {
namespace {

using Bytes = std::vector<glm::u8vec4>;

DecodedTexture decode(const std::string& file, const std::string& ending = "") {
    return decodeTexture({reinterpret_cast<const unsigned char*>(file.data()), file.size()}, ending);
}

std::string failure(const std::string& file, const std::string& ending = "") {
    try {
        decode(file, ending);
    } catch (const TextureFailure& failure) {
        return failure.what();
    }
    return "nothing failed";
}

TEST(TextureDecoder, ChannelsBecomeRgba) {
    EXPECT_EQ(decode(pngFile(2, 1, 1, {10, 20})).image.bytes, Bytes({{10, 10, 10, 255}, {20, 20, 20, 255}}));
    EXPECT_EQ(decode(pngFile(1, 1, 2, {10, 20})).image.bytes, Bytes({{10, 10, 10, 20}}));
    EXPECT_EQ(decode(pngFile(1, 1, 3, {10, 20, 30})).image.bytes, Bytes({{10, 20, 30, 255}}));
    // Colours under a small alpha are unchanged.
    EXPECT_EQ(decode(pngFile(1, 1, 4, {10, 20, 30, 0})).image.bytes, Bytes({{10, 20, 30, 0}}));
}

TEST(TextureDecoder, RowsGoDown) {
    const DecodedTexture decoded = decode(pngFile(1, 2, 1, {10, 20}));
    EXPECT_EQ(decoded.image.width, 1u);
    EXPECT_EQ(decoded.image.height, 2u);
    EXPECT_EQ(decoded.image.bytes[0].r, 10);
    EXPECT_FALSE(decoded.isLinear);
    EXPECT_TRUE(decoded.image.floats.empty());
}

TEST(TextureDecoder, MoreBitsThanEightAreFloats) {
    const DecodedTexture decoded = decode(pngFile(1, 1, 3, {0xff, 0xff, 0x80, 0x00, 0x00, 0x01}, 16));
    EXPECT_TRUE(decoded.image.bytes.empty());
    EXPECT_EQ(decoded.image.floats,
              std::vector<glm::vec4>({{1.0f, 32768.0f / 65535.0f, 1.0f / 65535.0f, 1.0f}}));
    EXPECT_FALSE(decoded.isLinear);
}

TEST(TextureDecoder, HdrIsLinear) {
    const DecodedTexture decoded = decode(hdrFile(2, 1, {128, 64, 0, 130, 0, 0, 0, 0}));
    EXPECT_TRUE(decoded.isLinear);
    EXPECT_EQ(decoded.image.floats, std::vector<glm::vec4>({{2, 1, 0, 1}, {0, 0, 0, 1}}));
}

TEST(TextureDecoder, Jpeg) {
    const DecodedTexture decoded = decode(jpegFile());
    EXPECT_EQ(decoded.image.bytes, Bytes(64, glm::u8vec4(200, 200, 200, 255)));
}

TEST(TextureDecoder, WebpKeepsColoursApartFromAlpha) {
#ifdef METAMARCH_WEBP
    const DecodedTexture decoded = decode(webpFile());
    ASSERT_EQ(decoded.image.bytes.size(), 16u);
    EXPECT_EQ(decoded.image.bytes[0], glm::u8vec4(200, 100, 50, 128));
    EXPECT_EQ(decoded.image.bytes[15], glm::u8vec4(200, 100, 50, 255));
#else
    EXPECT_EQ(failure(webpFile()), "is WebP, which needs a build with libwebp");
#endif
}

TEST(TextureDecoder, TargaIsKnownByItsEnding) {
    std::string file(18, '\0');
    file[2] = 2;   // uncompressed true colour
    file[12] = 1;  // width
    file[14] = 1;  // height
    file[16] = 24; // bits
    file += "\x1e\x14\x0a";
    EXPECT_EQ(decode(file, ".tga").image.bytes, Bytes({{10, 20, 30, 255}}));
    EXPECT_EQ(failure(file), "is no picture of a known format");
}

// An image cut off anywhere gives a failure and nothing else, nor any output on stderr.
TEST(TextureDecoder, CutOffAnywhere) {
    testing::internal::CaptureStderr();
    // The last chunk of a PNG, the last marker of a JPEG and the padding of a WebP carry no data.
    const std::vector<std::pair<std::string, std::size_t>> files = {
        {pngFile(2, 2, 4, std::vector<unsigned char>(16, 7)), 12},
        {jpegFile(), 4},
        {hdrFile(2, 2, std::vector<unsigned char>(16, 128)), 0},
#ifdef METAMARCH_WEBP
        {webpFile(), 4},
#endif
    };
    for (const auto& [file, end] : files) {
        for (std::size_t size = 0; size + end < file.size(); ++size) {
            EXPECT_NE(failure(file.substr(0, size)), "nothing failed") << size << " of " << file.size();
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(TextureDecoder, FlawsThatHideNoTexel) {
    const std::string png = pngFile(2, 1, 1, {10, 20});
    for (std::size_t missing = 1; missing <= 12; ++missing) {
        const DecodedTexture decoded = decode(png.substr(0, png.size() - missing));
        EXPECT_EQ(decoded.image.bytes, Bytes({{10, 10, 10, 255}, {20, 20, 20, 255}}));
        EXPECT_EQ(decoded.flaw, "has no end mark");
    }
    EXPECT_EQ(decode(png).flaw, "");
    // A comment with a wrong check sum, behind the header.
    const std::string comment("\0\0\0\3tEXta\0b\1\2\3\4", 15);
    const DecodedTexture decoded = decode(png.substr(0, 33) + comment + png.substr(33));
    EXPECT_EQ(decoded.image.bytes, Bytes({{10, 10, 10, 255}, {20, 20, 20, 255}}));
    EXPECT_EQ(decoded.flaw, "has a wrong check sum in a chunk that holds no texels");
    // Transparency is ancillary, but texels depend on it.
    const std::string transparency("\0\0\0\2tRNS\0\x0a\1\2\3\4", 14);
    EXPECT_EQ(failure(png.substr(0, 33) + transparency + png.substr(33)), "has a wrong check sum");
    const std::string jpeg = jpegFile();
    EXPECT_EQ(decode(jpeg.substr(0, jpeg.size() - 2)).flaw, "has no end mark");
    EXPECT_EQ(decode(jpeg.substr(0, jpeg.size() - 1)).flaw, "has no end mark");
    EXPECT_EQ(decode(jpeg).flaw, "");
}

TEST(TextureDecoder, WrongCheckSum) {
    std::string file = onePixelPng({1, 2, 3, 4});
    file[50] = static_cast<char>(file[50] ^ 1);
    EXPECT_EQ(failure(file), "has a wrong check sum");
}

// A header that claims a large image without the data costs no memory.
TEST(TextureDecoder, SizesOfHostileHeaders) {
    testing::internal::CaptureStderr(); // libpng prints complaints if all chunks are intact
    EXPECT_EQ(failure(pngFile(70000, 70000, 1, {})),
              "has 70000 x 70000 texels, more than the limit of 268435456");
    EXPECT_NE(failure(pngFile(16000, 16000, 1, {})), "nothing failed");
    EXPECT_NE(failure(hdrFile(16000, 16000, {1, 2, 3, 4})), "nothing failed");
    testing::internal::GetCapturedStderr();
}

TEST(TextureDecoder, AvifIsNamed) {
    EXPECT_EQ(failure(std::string("\0\0\0\x1c"
                                  "ftypavif",
                                  12)),
              "is an AVIF or HEIF picture (EXT_texture_avif), which is not supported");
}

TEST(TextureDecoder, KtxIsNamed) {
    EXPECT_EQ(failure("\xabKTX 20\xbb\r\n\x1a\n"),
              "is a KTX texture (KHR_texture_basisu), which is not supported");
}

} // namespace
} // namespace metamarch
