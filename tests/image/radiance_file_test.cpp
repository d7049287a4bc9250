// SPDX-License-Identifier: MIT
// Radiance pictures of every orientation, coding and kind of pixel.
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

namespace metamarch {
namespace {

const std::string kHeader = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n";

class RadianceFileTest : public testing::Test {
  protected:
    Image read(const std::string& content) {
        std::ofstream(folder / "a.hdr", std::ios::binary) << content;
        return readImage(folder / "a.hdr");
    }

    std::string refusal(const std::string& content) {
        return lineOfError(ErrorKind::inputRefused, [&] { read(content); });
    }

    TemporaryFolder folder;
};

std::string texel(int red, int green, int blue, int exponent) {
    return {static_cast<char>(red), static_cast<char>(green), static_cast<char>(blue),
            static_cast<char>(exponent)};
}

// A grey texel: with an exponent of 136 a mantissa stands for itself.
std::string grey(int value) { return texel(value, value, value, 136); }

std::vector<float> redOf(const Image& image) {
    std::vector<float> values;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        values.push_back(image.pixels[3 * i]);
    }
    return values;
}

// Radiance's formatval() skips blanks on both sides of the value.
TEST_F(RadianceFileTest, BlanksAroundTheFormat) {
    const auto redAfter = [&](const std::string& line) {
        return read("#?RADIANCE\n" + line + "\n\n-Y 1 +X 1\n" + texel(1, 0, 0, 136)).pixels.at(0);
    };
    for (const char* line :
         {"FORMAT= 32-bit_rle_rgbe", "FORMAT=32-bit_rle_rgbe \t", "FORMAT= \t32-bit_rle_rgbe\r"}) {
        EXPECT_EQ(redAfter(line), 1.0f) << line;
    }
    // 3.2409699 of X is red.
    EXPECT_FLOAT_EQ(redAfter("FORMAT= 32-bit_rle_xyze "), 3.2409699f);
}

TEST_F(RadianceFileTest, EveryOrientation) {
    // The picture is 10 20 30 over 40 50 60.
    const std::map<std::string, std::vector<int>> cases = {
        {"-Y 2 +X 3", {10, 20, 30, 40, 50, 60}}, {"-Y 2 -X 3", {30, 20, 10, 60, 50, 40}},
        {"+Y 2 +X 3", {40, 50, 60, 10, 20, 30}}, {"+Y 2 -X 3", {60, 50, 40, 30, 20, 10}},
        {"+X 3 -Y 2", {10, 40, 20, 50, 30, 60}}, {"+X 3 +Y 2", {40, 10, 50, 20, 60, 30}},
        {"-X 3 -Y 2", {30, 60, 20, 50, 10, 40}}, {"-X 3 +Y 2", {60, 30, 50, 20, 40, 10}},
    };
    for (const auto& [resolution, stored] : cases) {
        std::string content = kHeader + resolution + "\n";
        for (const int value : stored) {
            content += grey(value);
        }
        const Image image = read(content);
        EXPECT_EQ(image.width, 3) << resolution;
        EXPECT_EQ(image.channels, std::vector<std::string>({"R", "G", "B"}));
        EXPECT_EQ(redOf(image), std::vector<float>({10, 20, 30, 40, 50, 60})) << resolution;
    }
}

TEST_F(RadianceFileTest, MantissasAndExponents) {
    const Image image = read(kHeader + "-Y 1 +X 2\n" + texel(128, 64, 0, 130) + texel(9, 9, 9, 0));
    EXPECT_EQ(image.pixels, std::vector<float>({2, 1, 0, 0, 0, 0}));
}

TEST_F(RadianceFileTest, ComponentsInRuns) {
    // 8 texels: red 5 times 7 and then 1 2 3, green 8 times 4, blue and exponent likewise.
    const std::string runs = std::string("\x02\x02\x00\x08", 4) + "\x85\x07" + "\x03\x01\x02\x03" +
                             "\x88\x04" + "\x88\x05" + "\x88\x88";
    const Image image = read(kHeader + "-Y 1 +X 8\n" + runs);
    EXPECT_EQ(redOf(image), std::vector<float>({7, 7, 7, 7, 7, 1, 2, 3}));
    EXPECT_EQ(image.pixels[1], 4.0f);
    EXPECT_EQ(image.pixels[2], 5.0f);
    for (std::size_t size = 0; size < runs.size(); ++size) {
        EXPECT_NE(refusal(kHeader + "-Y 1 +X 8\n" + runs.substr(0, size)).find("cut off"), std::string::npos)
            << size;
    }
    EXPECT_NE(refusal(kHeader + "-Y 1 +X 9\n" + runs).find("another length than the header"),
              std::string::npos);
    std::string tooLong = runs;
    tooLong[4] = '\x89';
    EXPECT_NE(refusal(kHeader + "-Y 1 +X 8\n" + tooLong).find("scanline 0 is broken"), std::string::npos);
}

// A texel of 1 1 1 n repeats the last one n times, and a second one in a row 256 n times.
TEST_F(RadianceFileTest, PixelsInRuns) {
    const std::string runs = grey(7) + texel(1, 1, 1, 2) + texel(1, 1, 1, 1) + grey(9);
    const Image image =
        read(kHeader + "-Y 2 +X 260\n" + runs + grey(3) + texel(1, 1, 1, 3) + texel(1, 1, 1, 1));
    std::vector<float> expected(260, 7.0f);
    expected.back() = 9.0f;
    expected.insert(expected.end(), 260, 3.0f);
    EXPECT_EQ(redOf(image), expected);
    EXPECT_NE(refusal(kHeader + "-Y 1 +X 260\n" + texel(1, 1, 1, 2)).find("scanline 0 is broken"),
              std::string::npos);
    EXPECT_NE(refusal(kHeader + "-Y 1 +X 4\n" + grey(7) + texel(1, 1, 1, 4)).find("scanline 0 is broken"),
              std::string::npos);
}

// The white of Rec. 709 has X Y Z of 0.9505 1 1.0891, and its red 0.4124 0.2126 0.0193.
TEST_F(RadianceFileTest, XyzeBecomesRec709) {
    std::string header = kHeader;
    header.replace(header.find("rgbe"), 4, "xyze");
    const Image image = read(header + "-Y 1 +X 2\n" + texel(190, 200, 218, 136) + texel(206, 106, 10, 136));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(image.pixels[channel], 200.0f, 1.0f) << channel;
    }
    EXPECT_NEAR(image.pixels[3], 500.0f, 2.0f);
    EXPECT_NEAR(image.pixels[4], 0.0f, 1.0f);
    EXPECT_NEAR(image.pixels[5], 0.0f, 1.0f);
}

TEST_F(RadianceFileTest, BrokenHeaders) {
    const auto expect = [this](const std::string& content, const std::string& reason) {
        const std::string line = refusal(content);
        EXPECT_NE(line.find(reason), std::string::npos) << line;
    };
    expect("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "it is cut off before the end of its header");
    expect("#?RADIANCE\nFORMAT=16-bit\n\n-Y 1 +X 1\n", "its format '16-bit' is neither");
    expect("#?RADIANCE\nFORMAT= \n\n-Y 1 +X 1\n", "its format '' is neither");
    expect("#?RADIANCE\nFORMAT=32-bit rle rgbe\n\n-Y 1 +X 1\n", "its format '32-bit rle rgbe' is neither");
    for (const char* resolution :
         {"", "-Y 1", "-Y 1 +Y 1", "+Z 1 +X 1", "-Y 0 +X 1", "-Y -1 +X 1", "-Y a +X 1"}) {
        expect(kHeader + resolution + "\n" + grey(1), "is not of the form '-Y height +X width'");
    }
    expect(kHeader + "-Y 100000 +X 100000\n" + grey(1), "pixels are more than");
    expect(kHeader + "-Y 2000000000 +X 2000000000\n" + grey(1), "pixels are more than");
}

} // namespace
} // namespace metamarch
