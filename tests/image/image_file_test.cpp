// SPDX-License-Identifier: MIT
#include "file_size_limit.h"
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/file/output_file.h"
#include "metamarch/image/film_image.h"
#include "metamarch/image/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>

namespace metamarch {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// Returns a picture with every channel that an integrator writes, and with values that careless code loses.
Image everyChannel() {
    const Image empty = filmImage({}, {}, 0, 0, aovs());
    Image image(70, 67, empty.channels, empty.idChannels);
    const float special[] = {0.0f,
                             -0.0f,
                             -1.0f,
                             kInf,
                             -kInf,
                             std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::max(),
                             std::numeric_limits<float>::denorm_min(),
                             16777215.0f,
                             1.0f / 3.0f};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = i % 3 == 0 ? special[i % std::size(special)] : static_cast<float>(i);
    }
    for (std::size_t i = 0; i < image.ids.size(); ++i) {
        image.ids[i] = kNoId - static_cast<std::uint32_t>(i * 7919);
    }
    return image;
}

Image flat(std::vector<std::string> channels, std::vector<float> values) {
    Image image(1, 1, std::move(channels));
    image.pixels = std::move(values);
    return image;
}

// Returns the values of an 8-bit file, from 0 to 255.
std::vector<int> bytesOf(const Image& image) {
    std::vector<int> bytes;
    bytes.reserve(image.pixels.size());
    for (const float value : image.pixels) {
        bytes.push_back(static_cast<int>(std::lround(value * 255.0f)));
    }
    return bytes;
}

// A data window of 2 x 1 at column 1, row 2, in a display window of 4 x 3.
TEST(ImageFile, DataWindowIsPlacedInTheDisplayWindow) {
    const TemporaryFolder folder;
    const auto write = [&](int x, int y, int fullWidth, int fullHeight) {
        OIIO::ImageSpec spec(2, 1, 1, OIIO::TypeFloat);
        spec.x = x;
        spec.y = y;
        spec.full_width = fullWidth;
        spec.full_height = fullHeight;
        const float values[] = {5.0f, 6.0f};
        const auto output = OIIO::ImageOutput::create("exr");
        EXPECT_TRUE(output->open((folder / "a.exr").string(), spec));
        EXPECT_TRUE(output->write_image(OIIO::TypeFloat, values) && output->close());
        return folder / "a.exr";
    };
    const Image placed = readImage(write(1, 2, 4, 3));
    EXPECT_EQ(placed.width, 4);
    EXPECT_EQ(placed.pixels, std::vector<float>({0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 6, 0}));
    // What lies outside the display window is not part of the picture.
    EXPECT_EQ(readImage(write(-1, 0, 1, 1)).pixels, std::vector<float>({6}));
    expectError(ErrorKind::inputRefused, "its display window of 100000 x 100000 is too large",
                [&] { readImage(write(0, 0, 100000, 100000)); });
}

// Expects the same channels, to the bit, but for those that `isLossy` names.
void expectSamePicture(const Image& read, const Image& written,
                       const std::function<bool(const std::string&)>& isLossy = {}) {
    ASSERT_EQ(read.width, written.width);
    ASSERT_EQ(read.height, written.height);
    ASSERT_EQ(read.channels.size(), written.channels.size());
    ASSERT_EQ(read.idChannels.size(), written.idChannels.size());
    for (std::size_t pixel = 0; pixel < written.pixelCount(); ++pixel) {
        for (std::size_t channel = 0; channel < written.channels.size(); ++channel) {
            const std::string& name = written.channels[channel];
            const float value = read.pixels[pixel * read.channels.size() + read.findChannel(name).value()];
            const float expected = written.pixels[pixel * written.channels.size() + channel];
            ASSERT_TRUE(std::bit_cast<std::uint32_t>(value) == std::bit_cast<std::uint32_t>(expected) ||
                        (isLossy && isLossy(name)))
                << name << ", pixel " << pixel << ": " << value << ", expected " << expected;
        }
        for (std::size_t channel = 0; channel < written.idChannels.size(); ++channel) {
            const std::string& name = written.idChannels[channel];
            ASSERT_EQ(read.ids[pixel * read.idChannels.size() + read.findIdChannel(name).value()],
                      written.ids[pixel * written.idChannels.size() + channel])
                << name << ", pixel " << pixel;
        }
    }
}

TEST(ImageFile, ExrKeepsEveryBitOfEveryChannel) {
    const TemporaryFolder folder;
    const Image written = everyChannel();
    for (const ExrStorage& storage :
         {ExrStorage{}, ExrStorage{.compression = ExrCompression::zips},
          ExrStorage{.compression = ExrCompression::piz}, ExrStorage{.compression = ExrCompression::none},
          ExrStorage{.isTiled = true}, ExrStorage{.isMultipart = true},
          ExrStorage{.isTiled = true, .isMultipart = true}}) {
        writeImage(written, folder / "a.exr", {}, {.exr = storage});
        expectSamePicture(readImage(folder / "a.exr"), written);
    }
    EXPECT_EQ(folder.fileCount(), 1u) << "a temporary file is left";
}

// What 16 bits or a lossy method may change, and by how much.
TEST(ImageFile, ExrIsSmallerWhereThatIsAsked) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.exr";
    const Image special = everyChannel();
    writeImage(special, path, {}, {.exr = {.isHalf = true}});
    expectSamePicture(readImage(path), special, isSmall);

    Image gradient(64, 64, {"R", "G", "B", "A", "Z", "N.X", "albedo.R"}, {"id.mesh"});
    for (std::size_t i = 0; i < gradient.pixels.size(); ++i) {
        gradient.pixels[i] = static_cast<float>(i) * 1e-4f;
    }
    writeImage(gradient, path, {}, {.exr = {.isHalf = true, .compression = ExrCompression::dwaa}});
    const Image read = readImage(path);
    expectSamePicture(read, gradient, [](const std::string& name) { return name != "Z"; });
    for (const char* const name : {"R", "A", "N.X", "albedo.R"}) {
        const std::size_t a = gradient.findChannel(name).value();
        const std::size_t b = read.findChannel(name).value();
        EXPECT_NEAR(read.at(40, 50, b), gradient.at(40, 50, a), 0.01f) << name;
        EXPECT_NE(read.at(40, 50, b), gradient.at(40, 50, a)) << name;
    }

    // The largest number of 16 bits stands for larger ones, and infinity stays.
    writeImage(flat({"R", "G", "B"}, {1e9f, -kInf, -65505.0f}), path, {}, {.exr = {.isHalf = true}});
    const Image bright = readImage(path);
    EXPECT_EQ(bright.at(0, 0, bright.findChannel("R").value()), 65504.0f);
    EXPECT_EQ(bright.at(0, 0, bright.findChannel("G").value()), -kInf);
    EXPECT_EQ(bright.at(0, 0, bright.findChannel("B").value()), -65504.0f);
}

TEST(ImageFile, ExrHasAPartForEachLayer) {
    const TemporaryFolder folder;
    writeImage(Image(2, 2, {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}, {"id.mesh", "id.material"}),
               folder / "a.exr", {}, {.exr = {.isMultipart = true}});
    const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
    const std::vector<std::pair<std::string, std::vector<std::string>>> expected = {
        {"rgba", {"R", "G", "B", "A"}},
        {"Z", {"Z"}},
        {"N", {"N.X", "N.Y", "N.Z"}},
        {"id", {"id.material", "id.mesh"}}};
    for (std::size_t part = 0; part < expected.size(); ++part) {
        ASSERT_TRUE(input->seek_subimage(static_cast<int>(part), 0));
        EXPECT_EQ(input->spec().get_string_attribute("oiio:subimagename"), expected[part].first);
        EXPECT_EQ(input->spec().channelnames, expected[part].second);
    }
    EXPECT_FALSE(input->seek_subimage(static_cast<int>(expected.size()), 0));
}

TEST(ImageFile, PartsThatDoNotFitAreRefused) {
    const TemporaryFolder folder;
    const std::vector<float> values(4);
    const auto write = [&](const char* const channel) {
        std::vector<OIIO::ImageSpec> parts(2, OIIO::ImageSpec(2, 1, 1, OIIO::TypeFloat));
        parts[0].channelnames = {"Y"};
        parts[1].channelnames = {channel};
        parts[0].attribute("oiio:subimagename", "first");
        parts[1].attribute("oiio:subimagename", "second");
        std::string path = folder / "a.exr";
        const auto output = OIIO::ImageOutput::create("exr");
        EXPECT_TRUE(output->open(path, 2, parts.data()));
        EXPECT_TRUE(output->write_image(OIIO::TypeFloat, values.data()));
        EXPECT_TRUE(output->open(path, parts[1], OIIO::ImageOutput::AppendSubimage));
        EXPECT_TRUE(output->write_image(OIIO::TypeFloat, values.data()) && output->close());
        return path;
    };
    EXPECT_EQ(readImage(write("Z")).channels, (std::vector<std::string>{"Y", "Z"}));
    expectError(ErrorKind::inputRefused, "several of its parts have a channel Y",
                [&] { readImage(write("Y")); });

    const std::string pages = folder / "a.tif";
    const auto output = OIIO::ImageOutput::create("tiff");
    EXPECT_TRUE(output->open(pages, OIIO::ImageSpec(2, 1, 1, OIIO::TypeFloat)));
    EXPECT_TRUE(output->write_image(OIIO::TypeFloat, values.data()));
    EXPECT_TRUE(
        output->open(pages, OIIO::ImageSpec(3, 1, 1, OIIO::TypeFloat), OIIO::ImageOutput::AppendSubimage));
    EXPECT_TRUE(output->write_image(OIIO::TypeFloat, values.data()) && output->close());
    expectError(ErrorKind::inputRefused, "several parts of different sizes", [&] { readImage(pages); });
}

TEST(ImageFile, ExrIsZippedFloat) {
    const TemporaryFolder folder;
    writeImage(everyChannel(), folder / "a.exr");
    const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
    ASSERT_TRUE(input);
    for (int i = 0; i < input->spec().nchannels; ++i) {
        const std::string& name = input->spec().channelnames[static_cast<std::size_t>(i)];
        EXPECT_EQ(input->spec().channelformat(i),
                  name.starts_with("id.") || name == "samples" ? OIIO::TypeUInt32 : OIIO::TypeFloat)
            << name;
    }
    EXPECT_EQ(input->spec().get_string_attribute("compression"), "zip");
}

TEST(ImageFile, ExrKeepsTheAttributes) {
    const TemporaryFolder folder;
    Image image(1, 1, {"R"});
    image.attributes = {{"Software", "metamarch 0.1.0"},
                        {"metamarch/device", "llvmpipe (LLVM 15.0.6, 256 bits)"},
                        {"metamarch/scene", "Grüße.glb"}};
    writeImage(image, folder / "a.exr");
    const Image read = readImage(folder / "a.exr");
    for (const auto& attribute : image.attributes) {
        EXPECT_NE(std::find(read.attributes.begin(), read.attributes.end(), attribute), read.attributes.end())
            << attribute.first;
    }
}

TEST(ImageFile, PngIsToneMapped) {
    const TemporaryFolder folder;
    writeImage(flat({"R", "G", "B", "A", "Z"}, {0.18f, 2.0f, -1.0f, 1.0f, kInf}), folder / "a.png");
    const Image read = readImage(folder / "a.png");
    EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(bytesOf(read), (std::vector<int>{118, 255, 0, 255}));
}

// The operator `neutral` subtracts 0.04 from each colour and does not change alpha; EXR stays linear.
TEST(ImageFile, OnlyPngIsToneMappedAsAsked) {
    const TemporaryFolder folder;
    const ToneMapping neutral = {.toneOperator = kToneNeutral, .exposure = 1.0f};
    const Image image = flat({"R", "G", "B", "A"}, {0.06f, 0.135f, 0.07f, 0.5f});
    writeImage(image, folder / "a.png", neutral);
    EXPECT_EQ(bytesOf(readImage(folder / "a.png")), (std::vector<int>{124, 188, 134, 128}));
    writeImage(image, folder / "a.exr", neutral);
    const Image read = readImage(folder / "a.exr");
    EXPECT_EQ(read.at(0, 0, read.findChannel("G").value()), 0.135f);
}

TEST(ImageFile, PngWithoutAlphaHasThreeChannels) {
    const TemporaryFolder folder;
    writeImage(flat({"B", "G", "R"}, {1.0f, 0.5f, 0.0f}), folder / "a.png");
    EXPECT_EQ(bytesOf(readImage(folder / "a.png")), (std::vector<int>{0, 188, 255}));
}

// If a surface covers half of a pixel and the pixel's colour is 0.25, the surface's colour is 0.5.
TEST(ImageFile, PngColoursAreNotMultipliedByAlpha) {
    const TemporaryFolder folder;
    writeImage(flat({"R", "G", "B", "A"}, {0.25f, 0.0f, 0.5f, 0.5f}), folder / "a.png");
    EXPECT_EQ(bytesOf(readImage(folder / "a.png")), (std::vector<int>{188, 0, 255, 128}));
    writeImage(flat({"R", "G", "B", "A"}, {0.5f, 0.5f, 0.5f, 0.0f}), folder / "b.png");
    EXPECT_EQ(bytesOf(readImage(folder / "b.png")), (std::vector<int>{188, 188, 188, 0}));
}

TEST(ImageFile, PngNeedsColours) {
    const TemporaryFolder folder;
    const auto write = [&] { writeImage(Image(1, 1, {"Z"}), folder / "a.png"); };
    EXPECT_NE(lineOfError(ErrorKind::invalidArgument, write).find("R, G and B"), std::string::npos);
    EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(ImageFile, OnlyKnownEndings) {
    const TemporaryFolder folder;
    for (const char* name : {"a.gif", "a", "exr", ".exr", "a.exr.bak"}) {
        const std::string line =
            lineOfError(ErrorKind::invalidArgument, [&] { writeImage(Image(1, 1, {"R"}), folder / name); });
        EXPECT_EQ(line,
                  (folder / name).string() + ": a picture is written as .exr, .png, .jpg, .webp or .tif");
        EXPECT_EQ(line, lineOfError(ErrorKind::invalidArgument, [&] { checkWritable(folder / name); }));
    }
    writeImage(Image(1, 1, {"R"}), folder / "a.EXR");
}

TEST(ImageFile, CheckWritableTellsBeforeTheRender) {
    const TemporaryFolder folder;
    checkWritable(folder / "a.exr");
    EXPECT_EQ(folder.fileCount(), 0u);
    std::filesystem::create_directory(folder / "folder.exr");
    for (const char* name : {"no/a.exr", "folder.exr"}) {
        const std::string line =
            lineOfError(ErrorKind::outputNotWritable, [&] { checkWritable(folder / name); });
        EXPECT_EQ(line, lineOfError(ErrorKind::outputNotWritable,
                                    [&] { writeImage(Image(1, 1, {"R"}), folder / name); }));
    }
}

TEST(ImageFile, AFullDiskKeepsTheFormerPicture) {
    const TemporaryFolder folder;
    for (const char* name : {"a.exr", "a.png"}) {
        writeImage(Image(1, 1, {"R", "G", "B"}), folder / name);
        {
            const FileSizeLimit limit(1500);
            const std::string line = lineOfError(ErrorKind::outputNotWritable, [&] {
                Image noise(100, 100, {"R", "G", "B"});
                for (std::size_t i = 0; i < noise.pixels.size(); ++i) {
                    noise.pixels[i] = static_cast<float>(i * 7919 % 10007) / 10007.0f;
                }
                writeImage(noise, folder / name);
            });
            EXPECT_EQ(line, "cannot write " + (folder / name).string() + ": File too large");
        }
        EXPECT_EQ(readImage(folder / name).width, 1);
    }
    EXPECT_EQ(folder.fileCount(), 2u);
}

TEST(ImageFile, UnreadablePicturesAreRefused) {
    const TemporaryFolder folder;
    writeImage(everyChannel(), folder / "whole.exr");
    const auto half = std::filesystem::file_size(folder / "whole.exr") / 2;
    std::filesystem::copy(folder / "whole.exr", folder / "half.exr");
    std::filesystem::resize_file(folder / "half.exr", half);
    writeText(folder / "empty.exr", "");
    writeText(folder / "text.exr", "this is no picture\n");
    writeText(folder / "text.txt", "nor is this\n");
    for (const char* name : {"missing.exr", "half.exr", "empty.exr", "text.exr", "text.txt", ""}) {
        const std::string line = lineOfError(ErrorKind::inputRefused, [&] { readImage(folder / name); });
        EXPECT_EQ(line.find("cannot read " + (folder / name).string() + ": "), 0u) << line;
    }
}

TEST(ImageFile, ReadsTiles) {
    const TemporaryFolder folder;
    OIIO::ImageSpec spec(70, 67, 2, OIIO::TypeFloat);
    spec.channelnames = {"Y", "Z"};
    spec.tile_width = 16;
    spec.tile_height = 32;
    Image image(70, 67, spec.channelnames);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = static_cast<float>(i);
    }
    const auto output = OIIO::ImageOutput::create("exr");
    ASSERT_TRUE(output->open((folder / "a.exr").string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, image.pixels.data()));
    ASSERT_TRUE(output->close());
    EXPECT_EQ(readImage(folder / "a.exr").pixels, image.pixels);
}

} // namespace
} // namespace metamarch
