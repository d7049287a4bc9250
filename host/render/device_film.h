// SPDX-License-Identifier: MIT
// The sums of a path tracer's pixels on a device. A film that is larger than what a kernel may see of a
// buffer (maxStorageBufferRange) lies in several bands of tiles.
#pragma once
#include "metamarch/shared/film.h"
#include "metamarch/shared/tile_order.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/transfer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace metamarch::render {

class DeviceFilm {
  public:
    // Where the film lacks a part, its buffer has one pixel, because a binding needs a buffer.
    struct Band {
        vulkan::Buffer block; // the sums of the last block of each pixel
        vulkan::Buffer total; // those of all blocks before it
        vulkan::Buffer blockLight;
        vulkan::Buffer totalLight;
        vulkan::Buffer hits;
    };

    // What each tile takes of the device's memory.
    static std::uint64_t bytesOfTile(std::uint32_t parts);

    static constexpr std::uint32_t kAllTiles = std::numeric_limits<std::uint32_t>::max();

    // Allocates a film of `mostTiles` tiles with the parts kFilm… that `parts` names. A band has as many
    // tiles as the device lets a kernel see, and at most `mostOfBand`. Throws Error(outOfMemory) if the film
    // does not fit.
    DeviceFilm(const vulkan::Device& device, std::uint32_t mostTiles, std::uint32_t parts,
               std::uint32_t mostOfBand = kAllTiles);

    // Tile i of the film is tile i % tilesOfBand() of band i / tilesOfBand().
    std::uint32_t tilesOfBand() const { return tilesOfBand_; }
    const std::vector<Band>& bands() const { return bands_; }

    // Copies the values of the first tiles of the film, in the order [tile][pixel in tile].
    template <class T>
    std::vector<T> read(vulkan::Buffer Band::*const part, const std::uint32_t tiles) const {
        std::vector<T> values(std::size_t{tiles} * kTilePixels);
        forEachBand(std::span(values), [&](const Band& band, const std::span<T> ofBand) {
            vulkan::read(device_, band.*part, 0, std::as_writable_bytes(ofBand));
        });
        return values;
    }
    template <class T>
    void write(vulkan::Buffer Band::*const part, const std::vector<T>& values) const {
        forEachBand(std::span(values), [&](const Band& band, const std::span<const T> ofBand) {
            vulkan::write(device_, band.*part, 0, std::as_bytes(ofBand));
        });
    }

  private:
    template <class T, class Visit>
    void forEachBand(const std::span<T> values, const Visit& visit) const {
        const std::size_t most = std::size_t{tilesOfBand_} * kTilePixels;
        for (std::size_t first = 0; first < values.size(); first += most) {
            visit(bands_[first / most], values.subspan(first, std::min(most, values.size() - first)));
        }
    }

    const vulkan::Device& device_;
    std::uint32_t tilesOfBand_;
    std::vector<Band> bands_;
};

} // namespace metamarch::render
