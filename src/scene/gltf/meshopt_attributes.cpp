// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/meshopt_attributes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace metamarch {
namespace {

constexpr std::size_t kGroup = 16; // elements whose deltas share a bit length
constexpr unsigned kByteDeltas = 0;
constexpr unsigned kShortDeltas = 1;
constexpr unsigned kXorDeltas = 2;

// How many bits a delta has, by the two bits in a group's header; 0 means that all deltas are 0.
using BitLengths = std::array<unsigned, 4>;
constexpr BitLengths kVersion0 = {0, 2, 4, 8};
constexpr std::array<BitLengths, 2> kVersion1 = {{{0, 1, 2, 4}, {1, 2, 4, 8}}}; // by the control mode

// Thrown and caught in this file.
struct BrokenStream {};

class AttributeDecoder {
  public:
    AttributeDecoder(std::span<const unsigned char> stream, std::uint64_t count, std::uint64_t stride)
        : count_(count), stride_(stride), modes_(stride / 4, kByteDeltas) {
        if (stream.empty() || (stream[0] != 0xa0 && stream[0] != 0xa1)) {
            throw BrokenStream();
        }
        isVersion1_ = stream[0] == 0xa1;
        const std::size_t tail = stride + (isVersion1_ ? stride / 4 : 0);
        const std::size_t padded = std::max<std::size_t>(tail, isVersion1_ ? 24 : 32);
        if (stream.size() < 1 + padded) {
            throw BrokenStream();
        }
        rest_ = stream.subspan(1, stream.size() - 1 - padded);
        const std::span<const unsigned char> end = stream.last(tail);
        last_.assign(end.begin(), end.begin() + static_cast<std::ptrdiff_t>(stride));
        if (isVersion1_) {
            modes_.assign(end.begin() + static_cast<std::ptrdiff_t>(stride), end.end());
        }
        for (const unsigned char mode : modes_) {
            if ((mode & 15u) > kXorDeltas || ((mode & 15u) != kXorDeltas && mode >> 4 != 0)) {
                throw BrokenStream();
            }
        }
    }

    std::vector<unsigned char> decode() {
        std::vector<unsigned char> elements;
        const std::uint64_t most = std::min<std::uint64_t>((8192 / stride_) & ~std::uint64_t{15}, 256);
        for (std::uint64_t done = 0; done < count_;) {
            const std::uint64_t block = std::min(count_ - done, most);
            decodeBlock(elements, block);
            done += block;
        }
        if (!rest_.empty()) {
            throw BrokenStream();
        }
        return elements;
    }

  private:
    std::span<const unsigned char> take(std::size_t size) {
        if (size > rest_.size()) {
            throw BrokenStream();
        }
        const std::span<const unsigned char> taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }

    void decodeBlock(std::vector<unsigned char>& elements, std::size_t count) {
        const std::size_t groups = (count + kGroup - 1) / kGroup;
        const std::span<const unsigned char> controls =
            isVersion1_ ? take(stride_ / 4) : std::span<const unsigned char>();
        std::vector<unsigned char> deltas(stride_ * groups * kGroup, 0); // byte position by byte position
        for (std::size_t byte = 0; byte < stride_; ++byte) {
            const std::span<unsigned char> column =
                std::span(deltas).subspan(byte * groups * kGroup, groups * kGroup);
            const unsigned control = isVersion1_ ? controls[byte / 4] >> (2 * (byte % 4)) & 3u : 0u;
            if (control == 3) {
                std::ranges::copy(take(count), column.begin());
            } else if (control != 2) {
                readDeltas(column, groups, isVersion1_ ? kVersion1[control] : kVersion0);
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t channel = 0; channel < modes_.size(); ++channel) {
                std::array<unsigned char, 4> delta{};
                for (std::size_t k = 0; k < 4; ++k) {
                    delta[k] = deltas[(4 * channel + k) * groups * kGroup + i];
                }
                advance(channel, delta);
            }
            elements.insert(elements.end(), last_.begin(), last_.end());
        }
    }

    void readDeltas(std::span<unsigned char> column, std::size_t groups, const BitLengths& lengths) {
        const std::span<const unsigned char> headers = take((groups + 3) / 4);
        for (std::size_t group = 0; group < groups; ++group) {
            const unsigned bits = lengths[headers[group / 4] >> (2 * (group % 4)) & 3u];
            readGroup(column.subspan(group * kGroup, kGroup), bits);
        }
    }

    // A delta with all bits set stands for a whole byte behind the group.
    void readGroup(std::span<unsigned char> deltas, unsigned bits) {
        if (bits == 0) {
            return;
        }
        const std::span<const unsigned char> packed = take(kGroup * bits / 8);
        const unsigned perByte = 8 / bits;
        const unsigned mask = (1u << bits) - 1;
        for (unsigned i = 0; i < kGroup; ++i) {
            // Single bits begin at the lowest, longer deltas at the highest.
            const unsigned place = bits == 1 ? i % perByte : perByte - 1 - i % perByte;
            const unsigned delta = packed[i / perByte] >> (bits * place) & mask;
            deltas[i] = static_cast<unsigned char>(delta == mask && bits < 8 ? take(1)[0] : delta);
        }
    }

    template <class T>
    static T unzigzag(T value) {
        return static_cast<T>((value & 1) != 0 ? ~(value >> 1) : value >> 1);
    }

    // Adds the deltas of one channel, as they are coded, to the last element.
    void advance(std::size_t channel, const std::array<unsigned char, 4>& delta) {
        unsigned char* const bytes = &last_[4 * channel];
        const unsigned mode = modes_[channel];
        if ((mode & 15u) == kXorDeltas) {
            const std::uint32_t coded = std::uint32_t{delta[0]} | std::uint32_t{delta[1]} << 8 |
                                        std::uint32_t{delta[2]} << 16 | std::uint32_t{delta[3]} << 24;
            const std::uint32_t change = std::rotr(coded, static_cast<int>(mode >> 4));
            for (unsigned k = 0; k < 4; ++k) {
                bytes[k] = static_cast<unsigned char>(bytes[k] ^ (change >> (8 * k) & 255u));
            }
        } else if (mode == kShortDeltas) {
            for (unsigned k = 0; k < 4; k += 2) {
                const auto coded = static_cast<std::uint16_t>(delta[k] | delta[k + 1] << 8);
                const auto value =
                    static_cast<std::uint16_t>((bytes[k] | bytes[k + 1] << 8) + unzigzag(coded));
                bytes[k] = static_cast<unsigned char>(value & 255u);
                bytes[k + 1] = static_cast<unsigned char>(value >> 8);
            }
        } else {
            for (unsigned k = 0; k < 4; ++k) {
                bytes[k] = static_cast<unsigned char>(bytes[k] + unzigzag(delta[k]));
            }
        }
    }

    std::span<const unsigned char> rest_; // without header byte, padding and tail
    std::uint64_t count_;
    std::uint64_t stride_;
    bool isVersion1_ = false;
    std::vector<unsigned char> last_;  // the element before the next
    std::vector<unsigned char> modes_; // by channel of 4 bytes; the high four bits are a rotation
};

// Returns the number whose two's complement `bits` is.
template <class T>
int signedOf(const T bits) {
    constexpr int kCount = std::numeric_limits<T>::digits;
    return bits >> (kCount - 1) != 0 ? bits - (1 << kCount) : bits;
}

// T is the component.
template <class T>
void decodeColor(unsigned char* bytes) {
    std::array<T, 4> in{};
    std::memcpy(in.data(), bytes, sizeof in);
    // The highest bit of alpha tells how many bits the components have. Without any, all of them are 0.
    const auto range = static_cast<int>((1u << std::bit_width(static_cast<unsigned>(in[3]))) - 1u);
    const int y = in[0];
    const int co = signedOf(in[1]);
    const int cg = signedOf(in[2]);
    const int alpha = in[3] & (range >> 1);
    const float most = std::numeric_limits<T>::max();
    const float scale = range > 0 ? most / static_cast<float>(range) : 0.0f;
    const auto component = [&](int value) {
        return static_cast<T>(std::clamp(std::round(static_cast<float>(value) * scale), 0.0f, most));
    };
    const std::array<T, 4> out = {component(y + co - cg), component(y + cg), component(y - co - cg),
                                  component(alpha << 1 | (alpha & 1))};
    std::memcpy(bytes, out.data(), sizeof out);
}

} // namespace

std::optional<std::vector<unsigned char>> decodeMeshoptAttributes(std::span<const unsigned char> stream,
                                                                  std::uint64_t count, std::uint64_t stride) {
    try {
        return AttributeDecoder(stream, count, stride).decode();
    } catch (const BrokenStream&) {
        return std::nullopt;
    }
}

void decodeMeshoptColors(std::span<unsigned char> bytes, std::uint64_t stride) {
    for (std::size_t i = 0; i + stride <= bytes.size(); i += stride) {
        if (stride == 4) {
            decodeColor<std::uint8_t>(&bytes[i]);
        } else {
            decodeColor<std::uint16_t>(&bytes[i]);
        }
    }
}

} // namespace metamarch
