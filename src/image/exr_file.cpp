// SPDX-License-Identifier: MIT
#include "metamarch/image/exr_file.h"

#include "metamarch/error/error.h"
#include "metamarch/image/aov.h"
#include "metamarch/image/cryptomatte.h"
#include "metamarch/image/image_file.h"
#include "metamarch/image/picture_output.h"

#include <OpenImageIO/half.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace metamarch {
namespace {

constexpr int kTileSize = 64;

struct Channel {
    std::string name;
    bool isOfIds;
    std::size_t index; // in Image::channels or Image::idChannels
};

// A part of the file, which has some of the channels.
struct Part {
    std::string name;
    std::vector<Channel> channels;
};

// Colours and coverage have no name of a layer, and a channel alone is a layer of its own.
std::string layerOf(const std::string& channel) {
    if (channel == "R" || channel == "G" || channel == "B" || channel == "A") {
        return "rgba";
    }
    return channel.substr(0, channel.rfind('.'));
}

std::vector<Part> partsOf(const Image& image, const bool isMultipart) {
    std::vector<Part> parts;
    const auto add = [&](const std::string& channel, const bool isOfIds, const std::size_t index) {
        const std::string layer = isMultipart ? layerOf(channel) : "";
        auto part = std::ranges::find(parts, layer, &Part::name);
        if (part == parts.end()) {
            part = parts.insert(parts.end(), Part{layer, {}});
        }
        part->channels.push_back({channel, isOfIds, index});
    };
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
        add(image.channels[i], false, i);
    }
    for (std::size_t i = 0; i < image.idChannels.size(); ++i) {
        add(image.idChannels[i], true, i);
    }
    return parts;
}

OIIO::TypeDesc typeOf(const Channel& channel, const ExrStorage& storage) {
    if (channel.isOfIds) {
        return OIIO::TypeUInt32;
    }
    return storage.isHalf && isSmall(channel.name) ? OIIO::TypeHalf : OIIO::TypeFloat;
}

// OpenEXR's dwaa changes channels whose names end with R, G, B or Y, whatever they hold.
bool staysExact(const std::string& channel) { return isOfCryptomatte(channel) || channel.starts_with("P."); }

std::string compressionOf(const ExrStorage& storage) {
    switch (storage.compression) {
    case ExrCompression::zips:
        return "zips";
    case ExrCompression::piz:
        return "piz";
    case ExrCompression::dwaa:
        return fmt::format("dwaa:{}", storage.dwaaLevel);
    case ExrCompression::none:
        return "none";
    case ExrCompression::zip:
        break;
    }
    return "zip";
}

void addAttributes(const Image& image, OIIO::ImageSpec& spec) {
    // The same picture shall be the same bytes. OpenImageIO writes the time of day where this attribute is
    // absent, and nothing where it is no text, of which it would print a message.
    spec.attribute(kDateTime, 0);
    OIIO::attribute("debug", 0);
    for (const auto& [attribute, value] : image.attributes) {
        const std::string& name = attribute;
        std::visit(
            [&](const auto& held) {
                if constexpr (std::is_same_v<std::decay_t<decltype(held)>, glm::mat4>) {
                    // OpenEXR's matrices transform row vectors and are stored row by row: the same numbers.
                    spec.attribute(name, OIIO::TypeMatrix, &held);
                } else {
                    spec.attribute(name, held);
                }
            },
            value);
    }
}

OIIO::ImageSpec specOf(const Image& image, const Part& part, const ExrStorage& storage) {
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(part.channels.size()), OIIO::TypeFloat);
    spec.x = image.left;
    spec.y = image.top;
    spec.full_width = image.fullWidth > 0 ? image.fullWidth : image.width;
    spec.full_height = image.fullHeight > 0 ? image.fullHeight : image.height;
    spec.channelnames.clear();
    for (const Channel& channel : part.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(typeOf(channel, storage));
    }
    const bool isExact = std::ranges::any_of(part.channels, staysExact, &Channel::name);
    spec.attribute("compression",
                   isExact && storage.compression == ExrCompression::dwaa ? "zip" : compressionOf(storage));
    if (storage.isTiled) {
        spec.tile_width = kTileSize;
        spec.tile_height = kTileSize;
    }
    if (!part.name.empty()) {
        spec.attribute("oiio:subimagename", part.name);
    }
    addAttributes(image, spec);
    return spec;
}

// A number beyond the range of 16-bit floats becomes their largest one. Infinity stays.
float withinHalf(const float value) {
    constexpr float kMostOfHalf = 65504.0f;
    const bool isFinite = std::abs(value) <= std::numeric_limits<float>::max();
    return isFinite ? std::clamp(value, -kMostOfHalf, kMostOfHalf) : value;
}

// Copies the values of one channel into the pixels of a part.
void pack(const Image& image, const Channel& channel, const OIIO::TypeDesc& type,
          const std::size_t pixelBytes, std::byte* out) {
    for (std::size_t pixel = 0; pixel < image.pixelCount(); ++pixel, out += pixelBytes) {
        if (channel.isOfIds) {
            std::memcpy(out, &image.ids[pixel * image.idChannels.size() + channel.index], 4);
            continue;
        }
        const float value = image.pixels[pixel * image.channels.size() + channel.index];
        if (type == OIIO::TypeHalf) {
            const half small(withinHalf(value));
            std::memcpy(out, &small, 2);
        } else {
            std::memcpy(out, &value, 4);
        }
    }
}

} // namespace

void refuseLossyIds() {
    throw Error(ErrorKind::invalidArgument,
                "dwaa would change the points P and the ids of Cryptomatte; write several parts",
                {"compression", "multipart"});
}

void writeExr(const Image& image, const std::filesystem::path& path, const ExrStorage& storage) {
    if (storage.compression == ExrCompression::dwaa && !storage.isMultipart &&
        std::ranges::any_of(image.channels, staysExact)) {
        refuseLossyIds();
    }
    const std::vector<Part> parts = partsOf(image, storage.isMultipart);
    std::vector<OIIO::ImageSpec> specs;
    specs.reserve(parts.size());
    for (const Part& part : parts) {
        specs.push_back(specOf(image, part, storage));
    }
    writeParts(path, "exr", specs, [&](const std::size_t i) {
        const std::size_t pixelBytes = specs[i].pixel_bytes(true);
        std::vector<std::byte> bytes(image.pixelCount() * pixelBytes);
        std::size_t offset = 0;
        for (const Channel& channel : parts[i].channels) {
            const OIIO::TypeDesc type = typeOf(channel, storage);
            pack(image, channel, type, pixelBytes, bytes.data() + offset);
            offset += type.size();
        }
        return bytes;
    });
}

} // namespace metamarch
