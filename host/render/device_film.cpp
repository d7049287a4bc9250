// SPDX-License-Identifier: MIT
#include "metamarch/render/device_film.h"

namespace metamarch::render {
namespace {

constexpr std::uint64_t kHitBytes = kBlockSamples * sizeof(std::uint32_t);
static_assert(sizeof(FilmPixel) >= sizeof(LightParts) && sizeof(FilmPixel) >= kHitBytes); // the largest part

// Returns how many of the tiles a kernel sees with all their parts.
std::uint32_t mostTilesOfBand(const vulkan::Device& device, const std::uint32_t tiles) {
    const std::uint64_t most = device.report().maxStorageBufferRange / (kTilePixels * sizeof(FilmPixel));
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(most, 1, std::max(tiles, 1u)));
}

DeviceFilm::Band makeBand(const vulkan::Device& device, const std::uint32_t tiles,
                          const std::uint32_t parts) {
    const auto buffer = [&](const bool isThere, const std::uint64_t bytes, const char* const name) {
        return vulkan::Buffer(device, vulkan::BufferUse::storage,
                              isThere ? std::uint64_t{tiles} * kTilePixels * bytes : bytes, name);
    };
    const bool isLit = (parts & kFilmLight) != 0;
    return {buffer(true, sizeof(FilmPixel), "film"),
            buffer(true, sizeof(FilmPixel), "film of earlier blocks"),
            buffer(isLit, sizeof(LightParts), "light"),
            buffer(isLit, sizeof(LightParts), "light of earlier blocks"),
            buffer((parts & kFilmHits) != 0, kHitBytes, "first hits")};
}

} // namespace

std::uint64_t DeviceFilm::bytesOfTile(const std::uint32_t parts) {
    const std::uint64_t light = (parts & kFilmLight) != 0 ? sizeof(LightParts) : 0;
    const std::uint64_t hit = (parts & kFilmHits) != 0 ? kHitBytes : 0;
    return kTilePixels * (2 * (sizeof(FilmPixel) + light) + hit);
}

DeviceFilm::DeviceFilm(const vulkan::Device& device, const std::uint32_t mostTiles, const std::uint32_t parts,
                       const std::uint32_t mostOfBand)
    : device_(device), tilesOfBand_(mostTilesOfBand(device, std::min(mostTiles, mostOfBand))) {
    for (std::uint32_t first = 0; first == 0 || first < mostTiles; first += tilesOfBand_) {
        bands_.push_back(makeBand(device, std::min(tilesOfBand_, mostTiles - first), parts));
    }
}

} // namespace metamarch::render
