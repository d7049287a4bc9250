// SPDX-License-Identifier: MIT
#include "metamarch/image/image_file.h"

#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"
#include "metamarch/shared/packed_pixel.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>

namespace metamarch {
namespace {

// Lets OpenImageIO write into an OutputFile. OpenImageIO's own file classes do not report a full disk that
// only the last flush notices.
class OutputFileProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit OutputFileProxy(OutputFile& output) : IOProxy("", Write), file_(output) {}

    const char* proxytype() const override { return "metamarch"; }

    std::size_t write(const void* data, std::size_t size) override {
        const std::size_t written = pwrite(data, size, m_pos);
        m_pos += static_cast<std::int64_t>(written);
        return written;
    }

    std::size_t pwrite(const void* data, std::size_t size, std::int64_t offset) override {
        return file_.write(static_cast<std::uint64_t>(offset), data, size) ? size : 0;
    }

  private:
    OutputFile& file_;
};

std::string oneLine(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

void writePixels(const OIIO::ImageSpec& spec, const char* format, const OIIO::TypeDesc& type,
                 const void* pixels, const std::filesystem::path& path) {
    OutputFile file(path);
    OutputFileProxy proxy(file);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &proxy);
    bool done = output && output->open(path.string(), spec);
    done = done && output->write_image(type, pixels);
    done = output && output->close() && done;
    if (!done && !file.failed()) {
        const std::string reason = output ? output->geterror() : OIIO::geterror();
        throw Error(ErrorKind::outputNotWritable, "cannot write " + path.string() + ": " + oneLine(reason));
    }
    file.commit();
}

void writeExr(const Image& image, const std::filesystem::path& path) {
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), OIIO::TypeFloat);
    spec.channelnames = image.channels;
    spec.attribute("compression", "zip");
    // The same picture shall be the same bytes. OpenImageIO writes the time of day where this attribute is
    // absent, and nothing where it is no text, of which it would print a message.
    spec.attribute(kDateTime, 0);
    OIIO::attribute("debug", 0);
    for (const auto& [name, value] : image.attributes) {
        spec.attribute(name, value);
    }
    writePixels(spec, "exr", OIIO::TypeFloat, image.pixels.data(), path);
}

// PNG stores colours that are not multiplied by alpha. If alpha is 0, no division is possible and the colour
// stays.
float unassociated(float color, float alpha) { return alpha > 0.0f && alpha < 1.0f ? color / alpha : color; }

void writePng(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping) {
    const auto red = image.findChannel("R");
    const auto green = image.findChannel("G");
    const auto blue = image.findChannel("B");
    const auto alpha = image.findChannel("A");
    if (!red || !green || !blue) {
        throw Error(ErrorKind::invalidArgument,
                    path.string() + ": a PNG needs the channels R, G and B; write an .exr");
    }

    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixelCount() * 4);
    for (std::size_t pixel = 0; pixel < image.pixelCount(); ++pixel) {
        const float* values = &image.pixels[pixel * image.channels.size()];
        const float coverage = alpha ? values[*alpha] : 1.0f;
        const glm::vec3 radiance(unassociated(values[*red], coverage), unassociated(values[*green], coverage),
                                 unassociated(values[*blue], coverage));
        const glm::vec3 shown = toneMapped(toneMapping, radiance);
        for (int color = 0; color < 3; ++color) {
            bytes.push_back(static_cast<std::uint8_t>(toSrgb8(shown[color])));
        }
        if (alpha) {
            bytes.push_back(static_cast<std::uint8_t>(toLinear8(coverage)));
        }
    }

    OIIO::ImageSpec spec(image.width, image.height, alpha ? 4 : 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    writePixels(spec, "png", OIIO::TypeUInt8, bytes.data(), path);
}

} // namespace

PictureFormat pictureFormatOf(const std::filesystem::path& path) {
    const std::string ending = lowerCaseEnding(path);
    if (ending == ".exr") {
        return PictureFormat::exr;
    }
    if (ending == ".png") {
        return PictureFormat::png;
    }
    if (ending.empty() && OutputTarget(path).isStream()) {
        return PictureFormat::exr; // the format that holds all channels
    }
    throw Error(ErrorKind::invalidArgument, path.string() + ": a picture is written as .exr or .png");
}

void writeImage(const Image& image, const std::filesystem::path& path, const ToneMapping& toneMapping) {
    if (image.width <= 0 || image.height <= 0 || image.channels.empty() ||
        image.pixels.size() != image.pixelCount() * image.channels.size()) {
        throw std::invalid_argument("writeImage: size, channels and pixels do not fit together");
    }
    if (pictureFormatOf(path) == PictureFormat::exr) {
        writeExr(image, path);
    } else {
        writePng(image, path, toneMapping);
    }
}

void setImageThreads(const int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads > 1 ? threads : -1); // -1: the calling thread
}

void checkWritable(const std::filesystem::path& path) {
    pictureFormatOf(path);
    const OutputFile probe(path);
}

} // namespace metamarch
