// SPDX-License-Identifier: MIT
// A checksum of 64 bits over any bytes: finds damaged files and tells contents apart. It is no protection
// against somebody who wants two contents to agree.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace metamarch {

// The hash depends on the bytes and on how they are divided among the calls of add().
class ContentHash {
  public:
    void add(std::span<const std::byte> bytes);

    // The elements' bytes, also their padding, which must be set.
    template <class Values>
    void addAll(const Values& values) {
        add(std::as_bytes(std::span(values)));
    }

    std::uint64_t value() const { return state; }
    std::string text() const; // 16 hexadecimal digits

  private:
    void mix(std::uint64_t word);

    std::uint64_t state = 0;
};

} // namespace metamarch
