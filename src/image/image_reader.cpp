// SPDX-License-Identifier: MIT
// Implements readImage. Files are untrusted, so memory grows with the data that was really read, not with
// what a header says.
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/image/aov.h"
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

void checkSupported(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
    if (spec.deep) {
        refuse(path, "it is a deep picture; flatten it first");
    }
    if (spec.depth > 1) {
        refuse(path, "it is a volume");
    }
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
        refuse(path, "it has no pixels");
    }
}

// Neighbouring channels that are all whole numbers, or all not.
struct ChannelRun {
    int begin;
    int end;
    bool isOfIds;
    std::size_t first; // the index of the first one in Image::channels or Image::idChannels

    std::size_t count() const { return static_cast<std::size_t>(end - begin); }
};

// Adds the channels of `spec` to the picture. Only in an EXR are whole numbers of 32 bits ids; a TIFF's are
// colours.
std::vector<ChannelRun> addChannels(const OIIO::ImageSpec& spec, const bool isExr, Image& image) {
    std::vector<ChannelRun> runs;
    for (int i = 0; i < spec.nchannels; ++i) {
        const bool isOfIds = isExr && spec.channelformat(i) == OIIO::TypeUInt32;
        std::vector<std::string>& names = isOfIds ? image.idChannels : image.channels;
        if (runs.empty() || runs.back().isOfIds != isOfIds) {
            runs.push_back({i, i, isOfIds, names.size()});
        }
        ++runs.back().end;
        names.push_back(spec.channelnames[static_cast<std::size_t>(i)]);
    }
    return runs;
}

bool readRows(OIIO::ImageInput& input, const int part, const OIIO::ImageSpec& spec, const ChannelRun& run,
              const int yBegin, const int yEnd, const OIIO::TypeDesc& type, void* const rows) {
    if (spec.tile_width > 0) {
        return input.read_tiles(part, 0, spec.x, spec.x + spec.width, yBegin, yEnd, spec.z, spec.z + 1,
                                run.begin, run.end, type, rows);
    }
    return input.read_scanlines(part, 0, yBegin, yEnd, spec.z, run.begin, run.end, type, rows);
}

// Reads the run's values of some rows and appends them to `values`, of which a pixel has `stride`.
template <class T>
bool appendRows(OIIO::ImageInput& input, const int part, const OIIO::ImageSpec& spec, const ChannelRun& run,
                const int row, const int rows, const OIIO::TypeDesc& type, const std::size_t stride,
                std::vector<T>& values) {
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(spec.width);
    const std::size_t count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(spec.width);
    values.resize(std::max(values.size(), (first + count) * stride));
    const auto read = [&](T* const to) {
        return readRows(input, part, spec, run, spec.y + row, spec.y + row + rows, type, to);
    };
    if (run.count() == stride) {
        return read(&values[first * stride]);
    }
    std::vector<T> band(count * run.count());
    const bool isRead = read(band.data());
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        std::copy_n(&band[pixel * run.count()], run.count(), &values[(first + pixel) * stride + run.first]);
    }
    return isRead;
}

// Returns the part of the picture's frame, the display window, that the file's pixels fill: 0 or kNoId stands
// for the pixels that the file leaves out, and those outside the frame are dropped.
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
    Image frame(spec.full_width, spec.full_height, data.channels, data.idChannels);
    std::ranges::fill(frame.ids, kNoId);
    for (int y = 0; y < data.height; ++y) {
        for (int x = 0; x < data.width; ++x) {
            const std::int64_t column = std::int64_t{spec.x} - spec.full_x + x;
            const std::int64_t row = std::int64_t{spec.y} - spec.full_y + y;
            if (column < 0 || column >= frame.width || row < 0 || row >= frame.height) {
                continue;
            }
            const auto from = static_cast<std::size_t>(y) * static_cast<std::size_t>(data.width) +
                              static_cast<std::size_t>(x);
            const auto to = static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) +
                            static_cast<std::size_t>(column);
            std::copy_n(data.pixels.begin() + static_cast<std::ptrdiff_t>(from * data.channels.size()),
                        data.channels.size(),
                        frame.pixels.begin() + static_cast<std::ptrdiff_t>(to * data.channels.size()));
            std::copy_n(data.ids.begin() + static_cast<std::ptrdiff_t>(from * data.idChannels.size()),
                        data.idChannels.size(),
                        frame.ids.begin() + static_cast<std::ptrdiff_t>(to * data.idChannels.size()));
        }
    }
    return frame;
}

Image readPart(OIIO::ImageInput& input, const int part, const std::filesystem::path& path) {
    const OIIO::ImageSpec spec = input.spec();
    checkSupported(spec, path);
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    const std::vector<ChannelRun> runs =
        addChannels(spec, std::string_view(input.format_name()) == "openexr", image);
    const int band = spec.tile_width > 0 ? spec.tile_height : 64;
    for (int row = 0; row < spec.height; row += band) {
        const int rows = std::min(band, spec.height - row);
        for (const ChannelRun& run : runs) {
            const bool isRead = run.isOfIds ? appendRows(input, part, spec, run, row, rows, OIIO::TypeUInt32,
                                                         image.idChannels.size(), image.ids)
                                            : appendRows(input, part, spec, run, row, rows, OIIO::TypeFloat,
                                                         image.channels.size(), image.pixels);
            if (!isRead) {
                refuse(path, input.geterror());
            }
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

// Adds the channels of a further part.
void addPart(Image& image, const Image& part, const std::filesystem::path& path) {
    if (part.width != image.width || part.height != image.height) {
        refuse(path, "it has several parts of different sizes; give a picture of one part");
    }
    for (const std::vector<std::string>* const names : {&part.channels, &part.idChannels}) {
        for (const std::string& name : *names) {
            if (image.findChannel(name) || image.findIdChannel(name)) {
                refuse(path, fmt::format("several of its parts have a channel {}; give a picture of one part",
                                         name));
            }
        }
    }
    image.append(part);
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
    Image image = readPart(*input, 0, path);
    for (int part = 1; input->seek_subimage(part, 0); ++part) {
        addPart(image, readPart(*input, part, path), path);
    }
    return image;
}

} // namespace metamarch
