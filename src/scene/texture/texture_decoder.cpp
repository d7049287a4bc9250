// SPDX-License-Identifier: MIT
#include "metamarch/scene/texture/texture_decoder.h"

#include "metamarch/scene/texture/png_mend.h"
#include "metamarch/scene/texture/webp_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace metamarch {
namespace {

using namespace std::string_view_literals;

struct Format {
    std::string_view magic;
    const char* name; // OpenImageIO's name of the format
    bool isLinear = false;
};

constexpr std::array<Format, 10> kFormats = {{{"\x89PNG\r\n\x1a\n"sv, "png"},
                                              {"\xff\xd8\xff"sv, "jpeg"},
                                              {"RIFF"sv, "webp"},
                                              {"\x76\x2f\x31\x01"sv, "openexr", true},
                                              {"#?RADIANCE"sv, "hdr", true},
                                              {"#?RGBE"sv, "hdr", true},
                                              {"II*\0"sv, "tiff"},
                                              {"MM\0*"sv, "tiff"},
                                              {"BM"sv, "bmp"},
                                              {"GIF8"sv, "gif"}}};
constexpr Format kTarga = {"", "targa"};

// 16384 x 16384 texels take 1 GiB as bytes.
constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 28;

constexpr int kRowsAtOnce = 64;

Format formatOf(std::span<const unsigned char> bytes, const std::string& ending) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                                 std::min<std::size_t>(bytes.size(), 16));
    for (const Format& format : kFormats) {
        if (start.starts_with(format.magic)) {
            return format;
        }
    }
    if (ending == ".tga") {
        return kTarga;
    }
    if (start.starts_with("\xabKTX")) {
        throw TextureFailure("is a KTX texture (KHR_texture_basisu), which is not supported");
    }
    if (start.size() > 4 && start.substr(4).starts_with("ftyp")) {
        throw TextureFailure("is an AVIF or HEIF picture (EXT_texture_avif), which is not supported");
    }
    throw TextureFailure("is no picture of a known format");
}

void checkSize(const OIIO::ImageSpec& spec) {
    if (spec.deep || spec.depth > 1) {
        throw TextureFailure("is a deep picture or a volume");
    }
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
        throw TextureFailure("has no texels");
    }
    if (static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) > kMaxTexels) {
        throw TextureFailure("has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                             " texels, more than the limit of " + std::to_string(kMaxTexels));
    }
}

// Reads the first `channels` channels of every texel. The memory grows with the data actually read, not with
// the size that the header claims.
template <class T>
std::vector<T> readChannels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels,
                            OIIO::TypeDesc type) {
    const bool tiled = spec.tile_width > 0;
    const int band = tiled ? spec.tile_height : kRowsAtOnce;
    const std::size_t row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(channels);
    std::vector<T> values;
    for (int y = 0; y < spec.height; y += band) {
        const int rows = std::min(band, spec.height - y);
        const std::size_t begin = values.size();
        values.resize(begin + static_cast<std::size_t>(rows) * row);
        const int first = spec.y + y;
        const bool read = tiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, first, first + rows,
                                                   spec.z, spec.z + 1, 0, channels, type, &values[begin])
                                : input.read_scanlines(0, 0, first, first + rows, spec.z, 0, channels, type,
                                                       &values[begin]);
        // Some readers fill missing data with grey, set an error and still return success.
        if (!read || input.has_error()) {
            throw TextureFailure("cannot be decoded: " + input.geterror());
        }
    }
    return values;
}

// Copies grey to r, g and b. Images with one or three channels get the alpha `opaque`.
template <class T>
std::vector<glm::vec<4, T>> toTexels(const std::vector<T>& values, std::size_t channels, T opaque) {
    std::vector<glm::vec<4, T>> texels(values.size() / channels);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const T* const from = &values[i * channels];
        const bool grey = channels < 3;
        texels[i] = {from[0], grey ? from[0] : from[1], grey ? from[0] : from[2],
                     channels % 2 == 0 ? from[channels - 1] : opaque};
    }
    return texels;
}

void checkFinite(const TextureImage& image) {
    for (std::size_t i = 0; i < image.floats.size(); ++i) {
        const glm::vec4& texel = image.floats[i];
        if (!std::isfinite(texel.r) || !std::isfinite(texel.g) || !std::isfinite(texel.b) ||
            !std::isfinite(texel.a)) {
            throw TextureFailure("has a texel that is not finite, at " + std::to_string(i % image.width) +
                                 ',' + std::to_string(i / image.width));
        }
    }
}

TextureImage decode(OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
    checkSize(spec);
    TextureImage image;
    image.width = static_cast<std::uint32_t>(spec.width);
    image.height = static_cast<std::uint32_t>(spec.height);
    const int channels = std::min(spec.nchannels, 4);
    const auto count = static_cast<std::size_t>(channels);
    if (spec.format == OIIO::TypeUInt8) {
        image.bytes =
            toTexels<glm::u8>(readChannels<glm::u8>(input, spec, channels, OIIO::TypeUInt8), count, 255);
    } else {
        image.floats =
            toTexels<float>(readChannels<float>(input, spec, channels, OIIO::TypeFloat), count, 1.0f);
    }
    checkFinite(image);
    return image;
}

TextureImage decode(std::span<const unsigned char> bytes, const Format& format) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format.name);
    if (input == nullptr) {
        throw TextureFailure("is " + std::string(format.name) + ", which this OpenImageIO cannot read");
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data()), bytes.size());
    OIIO::ImageSpec request;
    request.attribute("oiio:UnassociatedAlpha", 1); // keep texels as stored
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&memory) || !input->open(std::string("texture.") + format.name, spec, request)) {
        throw TextureFailure("cannot be decoded: " + input->geterror());
    }
    return decode(*input, spec);
}

// A JPEG without its last marker is complete if it decodes without complaint once it has one.
DecodedTexture decodeJpeg(std::span<const unsigned char> bytes, const Format& format) {
    try {
        return {decode(bytes, format)};
    } catch (const TextureFailure&) {
        std::vector<unsigned char> ended(bytes.begin(), bytes.end());
        ended.insert(ended.end(), {0xff, 0xd9});
        try {
            return {decode(ended, format), false, "has no end mark"};
        } catch (const TextureFailure&) { // the first failure says more
        }
        throw;
    }
}

} // namespace

DecodedTexture decodeTexture(std::span<const unsigned char> bytes, const std::string& ending) {
    const Format format = formatOf(bytes, ending);
    if (format.name == "webp"sv) {
        return {decodeWebp(bytes)};
    }
    if (format.name == "jpeg"sv) {
        return decodeJpeg(bytes, format);
    }
    if (format.name == "png"sv) {
        const MendedPng png = mendPng(bytes);
        return {decode(png.bytes.empty() ? bytes : png.bytes, format), false, png.flaw};
    }
    return {decode(bytes, format), format.isLinear};
}

} // namespace metamarch
