// SPDX-License-Identifier: MIT
#include "metamarch/image/aov.h"
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace metamarch {
namespace {

constexpr std::pair<std::string_view, std::uint32_t> kBits[] = {{"8", 8}, {"16", 16}};

// dwaa is not among them, because it takes a level.
constexpr std::pair<std::string_view, ExrCompression> kCompressions[] = {{"zip", ExrCompression::zip},
                                                                         {"zips", ExrCompression::zips},
                                                                         {"piz", ExrCompression::piz},
                                                                         {"none", ExrCompression::none}};

void setCompression(const std::string& text, ExrStorage& storage) {
    const std::string method = text.substr(0, text.find(':'));
    if (method == "dwaa") {
        storage.compression = ExrCompression::dwaa;
        if (method.size() < text.size()) {
            storage.dwaaLevel = parseFloat(text.substr(method.size() + 1),
                                           {0.0, 100000.0, "dwaa:LEVEL with a level from 0 to 100000"});
        }
        return;
    }
    for (const auto& [name, compression] : kCompressions) {
        if (text == name) {
            storage.compression = compression;
            return;
        }
    }
    throw Error(ErrorKind::invalidArgument, "give zip, zips, piz, none, dwaa or dwaa:LEVEL");
}

std::string compressionText(const ExrStorage& storage) {
    for (const auto& [name, compression] : kCompressions) {
        if (compression == storage.compression) {
            return std::string(name);
        }
    }
    return fmt::format("dwaa:{}", storage.dwaaLevel);
}

} // namespace

void declareChannels(SettingList& list, std::vector<std::string>& names, float& missDepth) {
    list.beginGroup("Channels of an EXR");
    std::vector<std::string> known;
    for (const Aov& aov : aovs()) {
        if (aov.use == AovUse::usual || aov.use == AovUse::asked) {
            known.push_back(aov.name());
        }
    }
    list.words("aov", names,
               fmt::format("What to write besides R, G, B and A: all, or names with commas between: {}",
                           fmt::join(known, " ")))
        .withValueName("all|LIST");
    list.add("miss-depth", Setting::Kind::value,
             {[&missDepth](const std::string& text) {
                  missDepth = text == "inf" ? std::numeric_limits<float>::infinity()
                                            : parseFloat(text, {.wanted = "inf or a finite number"});
              },
              [&missDepth] { return fmt::format("{}", missDepth); }},
             "Z and t where nothing is seen; a number for programs that take no infinity")
        .withValueName("inf|DEPTH");
}

void declareStorage(SettingList& list, PictureStorage& storage) {
    list.beginGroup("Storage");
    list.choice("format", storage.format, kPictureFormats,
                "Of a picture whose name has no ending, such as -");
    list.choice("bits", storage.bits, kBits, "Of a colour in a PNG or TIFF");
    list.flag("half", storage.exr.isHalf, "16-bit floats for colours, coverage and normals of an EXR");
    list.add("compression", Setting::Kind::value,
             {[&storage](const std::string& text) { setCompression(text, storage.exr); },
              [&storage] { return compressionText(storage.exr); }},
             "Of an EXR: zip, zips, piz and none lose nothing; dwaa:LEVEL loses a little in colours")
        .withValueName("METHOD");
    list.flag("tiled", storage.exr.isTiled, "Store an EXR in tiles of 64 x 64 pixels");
    list.flag("multipart", storage.exr.isMultipart, "Store each layer of an EXR in a part of its own");
}

} // namespace metamarch
