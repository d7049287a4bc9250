// SPDX-License-Identifier: MIT
#include "metamarch/image/cryptomatte.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <map>

namespace metamarch {
namespace {

struct Matte {
    std::uint32_t id;
    std::uint32_t samples;
};

// The mattes of a pixel, the largest first. Equal ones are in the order of their ids, so that the picture
// does not depend on the order of the hits.
std::vector<Matte> mattesOf(const std::vector<HitCount>& hits, const std::vector<std::uint32_t>& idOfGroup) {
    std::vector<Matte> mattes;
    for (const HitCount& hit : hits) {
        const std::uint32_t id = idOfGroup[hit.group];
        const auto known = std::ranges::find(mattes, id, &Matte::id);
        if (known == mattes.end()) {
            mattes.push_back({id, hit.samples});
        } else {
            known->samples += hit.samples;
        }
    }
    std::ranges::sort(mattes, [](const Matte& a, const Matte& b) {
        return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
    });
    return mattes;
}

// The four bytes of a block, the lowest first, as the hash is defined.
std::uint32_t wordAt(const std::string_view text, const std::size_t begin, const std::size_t bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[begin + i])) << (8 * i);
    }
    return word;
}

// Returns a name as the manifest can hold it: bytes that are no UTF-8 are replaced. The hash is of this text,
// because readers hash the manifest's.
std::string nameInManifest(const std::string& name) {
    constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
    return nlohmann::json::parse(nlohmann::json(name).dump(-1, ' ', false, kReplace)).get<std::string>();
}

} // namespace

std::uint32_t murmurHash3(const std::string_view text) {
    const auto mixed = [](const std::uint32_t word) {
        return std::rotl(word * 0xcc9e2d51u, 15) * 0x1b873593u;
    };
    std::uint32_t hash = 0;
    const std::size_t blocks = text.size() / 4;
    for (std::size_t block = 0; block < blocks; ++block) {
        hash = std::rotl(hash ^ mixed(wordAt(text, 4 * block, 4)), 13) * 5 + 0xe6546b64u;
    }
    hash ^= mixed(wordAt(text, 4 * blocks, text.size() % 4));
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ (hash >> 16)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13)) * 0xc2b2ae35u;
    return hash ^ (hash >> 16);
}

std::uint32_t cryptomatteId(const std::string_view name) {
    const std::uint32_t hash = murmurHash3(name);
    const std::uint32_t exponent = (hash >> 23) & 255u;
    return exponent == 0 || exponent == 255 ? hash ^ (1u << 23) : hash;
}

void addCryptomatte(const CryptomatteLevel& level, const FilmData& film, Image& image) {
    std::vector<std::uint32_t> idOfGroup;
    std::map<std::string, std::string> manifest; // sorted: the same scene has the same header
    for (const std::string& given : level.nameOfGroup) {
        const std::string name = nameInManifest(given);
        idOfGroup.push_back(cryptomatteId(name));
        manifest[name] = fmt::format("{:08x}", idOfGroup.back());
    }
    std::vector<std::string> channels;
    for (std::size_t rank = 0; rank < kCryptomatteRanks; ++rank) {
        const char* const parts = rank % 2 == 0 ? "RG" : "BA"; // id and coverage
        for (int i = 0; i < 2; ++i) {
            channels.push_back(fmt::format("{}{:02}.{}", level.layer, rank / 2, parts[i]));
        }
    }
    Image mattes(image.width, image.height, std::move(channels));
    for (std::size_t pixel = 0; pixel < mattes.pixelCount(); ++pixel) {
        const std::vector<Matte> found = mattesOf(film.hits[pixel], idOfGroup);
        const auto samples = static_cast<float>(std::max(film.pixels[pixel].samples, 1u));
        for (std::size_t rank = 0; rank < std::min(found.size(), kCryptomatteRanks); ++rank) {
            float* const out = &mattes.pixels[2 * (pixel * kCryptomatteRanks + rank)];
            out[0] = std::bit_cast<float>(found[rank].id);
            out[1] = static_cast<float>(found[rank].samples) / samples;
        }
    }
    image.append(mattes);

    const std::string key =
        fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", murmurHash3(level.layer)));
    const std::string json = nlohmann::json(manifest).dump();
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"name", level.layer},
                                      {"hash", "MurmurHash3_32"},
                                      {"conversion", "uint32_to_float32"},
                                      {"manifest", json}}) {
        image.attributes.emplace_back(key + name, value);
    }
}

bool isOfCryptomatte(const std::string_view channel) { return channel.starts_with("Crypto"); }

} // namespace metamarch
