// SPDX-License-Identifier: MIT
// Implements readImage. Files are untrusted, so memory grows with the data that was really read, not with
// what a header says.
#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace metamarch {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string reason) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ErrorKind::inputRefused, "cannot read " + path.string() + ": " + reason);
}

std::unique_ptr<OIIO::ImageInput> openPicture(const std::filesystem::path& path) {
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

} // namespace

Image readImage(const std::filesystem::path& path) {
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
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeString) {
            image.attributes.emplace_back(attribute.name().string(), attribute.get_string());
        }
    }
    return image;
}

} // namespace metamarch
