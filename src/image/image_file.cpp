// SPDX-License-Identifier: MIT
#include "metamarch/image/image_file.h"

#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"
#include "metamarch/image/picture_output.h"
#include "metamarch/shared/packed_pixel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace metamarch {
namespace {

// PNG stores colours that are not multiplied by alpha. If alpha is 0, no division is possible and the colour
// stays.
float unassociated(float color, float alpha) { return alpha > 0.0f && alpha < 1.0f ? color / alpha : color; }

// What distinguishes the formats that hold a picture for people.
struct ShownFormat {
    PictureFormat format;
    const char* plugin; // of OpenImageIO
    bool hasAlpha;
    bool hasWords; // 16 bits for a colour
};

constexpr ShownFormat kShownFormats[] = {{PictureFormat::png, "png", true, true},
                                         {PictureFormat::jpeg, "jpeg", false, false},
                                         {PictureFormat::webp, "webp", true, false},
                                         {PictureFormat::tiff, "tiff", true, true}};

const ShownFormat& shownFormat(const PictureFormat format) {
    return *std::ranges::find(kShownFormats, format, &ShownFormat::format);
}

// JPEG and WebP lose little at this quality, of 100.
constexpr int kQuality = 95;

constexpr std::pair<std::string_view, PictureFormat> kEndings[] = {
    {".exr", PictureFormat::exr},   {".png", PictureFormat::png},   {".jpg", PictureFormat::jpeg},
    {".jpeg", PictureFormat::jpeg}, {".webp", PictureFormat::webp}, {".tif", PictureFormat::tiff},
    {".tiff", PictureFormat::tiff}};

// Appends a number of [0, 1] as a whole number of 8 or 16 bits.
void append(std::vector<std::byte>& bytes, const float value, const std::uint32_t bits) {
    if (bits == 8) {
        bytes.push_back(static_cast<std::byte>(toLinear8(value)));
        return;
    }
    const float inside = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    const auto word = static_cast<std::uint16_t>(std::lround(inside * 65535.0f));
    bytes.insert(bytes.end(), 2, std::byte{});
    std::memcpy(&bytes[bytes.size() - 2], &word, 2);
}

// Returns the tone-mapped colours of all pixels, each followed by its coverage if `hasAlpha` and if the
// picture has a channel A. Throws Error(invalidArgument), beginning with `name`.
std::vector<std::byte> shownBytes(const Image& image, const ToneMapping& toneMapping, const bool hasAlpha,
                                  const std::uint32_t bits, const std::string& name) {
    const auto red = image.findChannel("R");
    const auto green = image.findChannel("G");
    const auto blue = image.findChannel("B");
    const auto alpha = hasAlpha ? image.findChannel("A") : std::nullopt;
    if (!red || !green || !blue) {
        throw Error(ErrorKind::invalidArgument, name + " needs the channels R, G and B; write an .exr");
    }
    std::vector<std::byte> bytes;
    bytes.reserve(image.pixelCount() * 4 * (bits / 8));
    for (std::size_t pixel = 0; pixel < image.pixelCount(); ++pixel) {
        const float* values = &image.pixels[pixel * image.channels.size()];
        const float coverage = alpha ? values[*alpha] : 1.0f;
        const glm::vec3 radiance(unassociated(values[*red], coverage), unassociated(values[*green], coverage),
                                 unassociated(values[*blue], coverage));
        const glm::vec3 shown = toneMapped(toneMapping, radiance);
        for (int color = 0; color < 3; ++color) {
            append(bytes, srgbCoded(std::min(shown[color], 1.0f)), bits);
        }
        if (alpha) {
            append(bytes, coverage, bits);
        }
    }
    return bytes;
}

void writeShown(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping,
                const ShownFormat& format, const std::uint32_t bits) {
    std::vector<std::byte> bytes =
        shownBytes(image, toneMapping, format.hasAlpha, bits, path.string() + ": a PNG");
    const bool hasAlpha = format.hasAlpha && image.findChannel("A");
    OIIO::ImageSpec spec(image.width, image.height, hasAlpha ? 4 : 3,
                         bits == 8 ? OIIO::TypeUInt8 : OIIO::TypeUInt16);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", kQuality);
    spec.attribute(kDateTime, 0); // as in addAttributes of exr_file.cpp
    writeParts(path, format.plugin, {&spec, 1}, [&](std::size_t) { return std::move(bytes); });
}

[[noreturn]] void refuseOutput(const std::filesystem::path& path, const std::string& reason,
                               std::vector<std::string> settings = {}) {
    throw Error(ErrorKind::invalidArgument, path.string() + ": " + reason, std::move(settings));
}

PictureFormat formatByName(const std::filesystem::path& path, const std::optional<PictureFormat> wanted) {
    const std::string ending = lowerCaseEnding(path);
    const auto* const known =
        std::ranges::find(kEndings, ending, &std::pair<std::string_view, PictureFormat>::first);
    if (known != std::end(kEndings)) {
        if (wanted && *wanted != known->second) {
            refuseOutput(path, "the ending stands for another format", {"format"});
        }
        return known->second;
    }
    if (ending.empty() && OutputTarget(path).isStream()) {
        return wanted.value_or(PictureFormat::exr); // the format that holds all channels
    }
    refuseOutput(path, "a picture is written as .exr, .png, .jpg, .webp or .tif");
}

} // namespace

PictureFormat pictureFormatOf(const std::filesystem::path& path, const PictureStorage& storage) {
    const PictureFormat format = formatByName(path, storage.format);
    if (format == PictureFormat::exr) {
        if (storage.bits != 8) {
            refuseOutput(path, "a PNG or a TIFF has 8 or 16 bits, an EXR has floats", {"bits"});
        }
        return format;
    }
    if (!(storage.exr == ExrStorage{})) {
        refuseOutput(path, "only an EXR has these", {"half", "compression", "tiled", "multipart"});
    }
    if (storage.bits != 8 && !shownFormat(format).hasWords) {
        refuseOutput(path, "only a PNG or a TIFF has 16 bits", {"bits"});
    }
    return format;
}

void writeImage(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping,
                const PictureStorage& storage) {
    if (image.width <= 0 || image.height <= 0 || image.channels.size() + image.idChannels.size() == 0 ||
        image.pixels.size() != image.pixelCount() * image.channels.size() ||
        image.ids.size() != image.pixelCount() * image.idChannels.size()) {
        throw std::invalid_argument("writeImage: size, channels and pixels do not fit together");
    }
    const PictureFormat format = pictureFormatOf(path, storage);
    if (format == PictureFormat::exr) {
        writeExr(image, path, storage.exr);
    } else {
        writeShown(image, path, toneMapping, shownFormat(format), storage.bits);
    }
}

std::vector<std::uint8_t> rgba8Of(const Image& image, const ToneMapping& toneMapping) {
    const std::vector<std::byte> bytes = shownBytes(image, toneMapping, true, 8, "a picture for a screen");
    const std::size_t colors = image.findChannel("A") ? 4 : 3;
    std::vector<std::uint8_t> rgba(image.pixelCount() * 4, 255);
    for (std::size_t pixel = 0; pixel < image.pixelCount(); ++pixel) {
        std::memcpy(&rgba[pixel * 4], &bytes[pixel * colors], colors);
    }
    return rgba;
}

void setImageThreads(const int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads > 1 ? threads : -1); // -1: the calling thread
}

void forgetImageThreads() {
    setImageThreads(1);
    // When a file is begun, OpenEXR drops the threads that it no longer wants and then waits for their end.
    // That throws where they do not exist, with OpenEXR 3.1.13, and once only.
    try {
        OIIO::ImageOutput::create("exr");
    } catch (const std::system_error&) {
    }
}

void checkWritable(const std::filesystem::path& path, const PictureStorage& storage) {
    pictureFormatOf(path, storage);
    const OutputFile probe(path);
}

} // namespace metamarch
