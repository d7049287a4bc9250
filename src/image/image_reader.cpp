// SPDX-License-Identifier: MIT
// Implements readImage. Files are untrusted, so memory grows with the data that was really read, not with
// what a header says.
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/radiance_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <unistd.h>

namespace metamarch {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string reason) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ErrorKind::inputRefused, "cannot read " + path.string() + ": " + reason);
}

void checkReachable(const std::filesystem::path& path) {
    std::error_code unreachable;
    const std::filesystem::file_status status = std::filesystem::status(path, unreachable);
    if (unreachable) {
        refuse(path, unreachable.message());
    }
    if (std::filesystem::is_directory(status)) {
        refuse(path, "it is a folder");
    }
    if (std::filesystem::exists(status) && access(path.c_str(), R_OK) != 0) {
        refuse(path, std::strerror(errno));
    }
}

bool startsAsRadiance(const std::filesystem::path& path) {
    std::array<unsigned char, 2> start{};
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(start.data()), start.size());
    return isRadiance(start);
}

std::unique_ptr<OIIO::ImageInput> openPicture(const std::filesystem::path& path) {
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1); // values as stored
    auto input = OIIO::ImageInput::open(path.string(), &request);
    if (!input) {
        refuse(path, OIIO::geterror());
    }
    return input;
}

void checkSupported(OIIO::ImageInput& input, const std::filesystem::path& path) {
    const OIIO::ImageSpec spec = input.spec();
    if (spec.deep) {
        refuse(path, "it is a deep picture; flatten it first");
    }
    if (spec.depth > 1) {
        refuse(path, "it is a volume");
    }
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
        refuse(path, "it has no pixels");
    }
    if (input.seek_subimage(1, 0)) {
        refuse(path, "it has several parts; give a picture of one part");
    }
    input.seek_subimage(0, 0);
}

bool readRows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int yBegin, int yEnd, float* rows) {
    if (spec.tile_width > 0) {
        return input.read_tiles(0, 0, spec.x, spec.x + spec.width, yBegin, yEnd, spec.z, spec.z + 1, 0,
                                spec.nchannels, OIIO::TypeFloat, rows);
    }
    return input.read_scanlines(0, 0, yBegin, yEnd, spec.z, 0, spec.nchannels, OIIO::TypeFloat, rows);
}

// Returns the part of the picture's frame, the display window, that the file's pixels fill: 0 stands for the
// pixels that the file leaves out, and those outside the frame are dropped.
Image framed(Image data, const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
    const bool isWhole = spec.full_x == spec.x && spec.full_y == spec.y && spec.full_width == spec.width &&
                         spec.full_height == spec.height;
    if (isWhole || spec.full_width <= 0 || spec.full_height <= 0) {
        return data;
    }
    // A header may claim any frame: it may have 2^24 pixels, or 64 for each one that the file holds.
    const std::uint64_t most = std::max<std::uint64_t>(std::uint64_t{1} << 24, 64 * data.pixelCount());
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(spec.full_width) * static_cast<std::uint64_t>(spec.full_height);
    if (pixels > most) {
        refuse(path, fmt::format("its display window of {} x {} is too large for its data window of {} x {}",
                                 spec.full_width, spec.full_height, spec.width, spec.height));
    }
    Image frame(spec.full_width, spec.full_height, data.channels);
    for (int y = 0; y < data.height; ++y) {
        for (int x = 0; x < data.width; ++x) {
            const std::int64_t column = std::int64_t{spec.x} - spec.full_x + x;
            const std::int64_t row = std::int64_t{spec.y} - spec.full_y + y;
            if (column < 0 || column >= frame.width || row < 0 || row >= frame.height) {
                continue;
            }
            for (std::size_t channel = 0; channel < data.channels.size(); ++channel) {
                frame.at(static_cast<int>(column), static_cast<int>(row), channel) = data.at(x, y, channel);
            }
        }
    }
    return frame;
}

} // namespace

Image readImage(const std::filesystem::path& path) {
    checkReachable(path);
    if (startsAsRadiance(path)) {
        const std::optional<std::vector<unsigned char>> bytes = readBytes(path);
        if (!bytes) {
            refuse(path, "it cannot be opened and read to its end");
        }
        return readRadiance(*bytes, path);
    }
    const std::unique_ptr<OIIO::ImageInput> input = openPicture(path);
    checkSupported(*input, path);
    const OIIO::ImageSpec spec = input->spec();

    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.channelnames;
    const std::size_t rowValues = static_cast<std::size_t>(spec.width) * image.channels.size();
    const int band = spec.tile_width > 0 ? spec.tile_height : 64;
    for (int row = 0; row < spec.height; row += band) {
        const int rows = std::min(band, spec.height - row);
        const std::size_t begin = image.pixels.size();
        image.pixels.resize(begin + static_cast<std::size_t>(rows) * rowValues);
        if (!readRows(*input, spec, spec.y + row, spec.y + row + rows, &image.pixels[begin])) {
            refuse(path, input->geterror());
        }
    }
    image = framed(std::move(image), spec, path);
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeString) {
            image.attributes.emplace_back(attribute.name().string(), attribute.get_string());
        }
    }
    return image;
}

} // namespace metamarch
