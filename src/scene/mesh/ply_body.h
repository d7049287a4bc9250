// SPDX-License-Identifier: MIT
// The numbers behind the header of a PLY file, one after another.
#pragma once
#include "metamarch/scene/mesh/ply_header.h"
#include "metamarch/scene/mesh/stored_number.h"
#include "metamarch/scene/mesh/text_scanner.h"

#include <bit>

namespace metamarch {

// The element that is being read, for messages.
class PlyPlace {
  public:
    explicit PlyPlace(const InputFile& file) : file_(file) {}

    void set(const PlyElement& element, std::uint64_t index) {
        element_ = &element;
        index_ = index;
    }

    [[noreturn]] void refuse(const std::string& what) const {
        file_.refuse("PLY " + element_->name.substr(0, 40) + ' ' + std::to_string(index_) + ": " + what);
    }

  private:
    const InputFile& file_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};

// The numbers of an element are in one line, unless `isFreeForm`.
class PlyTextBody {
  public:
    PlyTextBody(std::string_view body, const PlyPlace& place, bool isFreeForm)
        : scanner_(body), place_(place), isFreeForm_(isFreeForm) {}

    void beginElement() {
        if (isFreeForm_) {
            return;
        }
        finishLine();
        word_ = wordOfLaterLine();
    }

    double read(PlyType) {
        std::string_view word = word_.empty() ? scanner_.nextWord() : word_;
        word_ = {};
        if (word.empty()) {
            word = isFreeForm_ ? wordOfLaterLine() : refuseLine();
        }
        const std::optional<double> number = parseNumber(word);
        if (!number) {
            place_.refuse(inQuotes(word) + " is not a number");
        }
        return *number;
    }

    // A list that is longer than the file meets the end of its line or of the file.
    void checkRoom(double /*entries*/, PlyType) const {}

    // Whether nothing but blanks is left. Reads them.
    bool isAtEnd() { return scanner_.nextWordOverLines().empty(); }

    // Ends the line of the last element. Returns the bytes behind it, from the first word on.
    std::size_t finish() {
        finishLine();
        const std::string_view word = scanner_.wordOfLaterLine();
        return word.empty() ? 0 : scanner_.bytesFrom(word);
    }

    // How many lines have more numbers than their element. They are ignored.
    std::uint64_t longLines() const { return longLines_; }

  private:
    void finishLine() {
        if (!scanner_.nextWord().empty()) {
            ++longLines_;
        }
    }

    std::string_view wordOfLaterLine() {
        const std::string_view word = scanner_.wordOfLaterLine();
        if (word.empty()) {
            place_.refuse("the file ends here");
        }
        return word;
    }

    [[noreturn]] std::string_view refuseLine() const { place_.refuse("the line ends here"); }

    TextScanner scanner_;
    const PlyPlace& place_;
    bool isFreeForm_;
    std::string_view word_; // the first of the element, which beginElement has read
    std::uint64_t longLines_ = 0;
};

template <std::endian order>
class PlyBinaryBody {
  public:
    PlyBinaryBody(std::string_view body, const PlyPlace& place) : rest_(body), place_(place) {}

    void beginElement() {}

    // Returns the bytes behind the last element.
    std::size_t finish() const { return rest_.size(); }

    double read(PlyType type) {
        switch (type) {
        case PlyType::int8:
            return static_cast<std::int8_t>(bits<std::uint8_t>());
        case PlyType::uint8:
            return bits<std::uint8_t>();
        case PlyType::int16:
            return static_cast<std::int16_t>(bits<std::uint16_t>());
        case PlyType::uint16:
            return bits<std::uint16_t>();
        case PlyType::int32:
            return static_cast<std::int32_t>(bits<std::uint32_t>());
        case PlyType::uint32:
            return bits<std::uint32_t>();
        case PlyType::float32:
            return static_cast<double>(std::bit_cast<float>(bits<std::uint32_t>()));
        case PlyType::float64:
            return std::bit_cast<double>(bits<std::uint64_t>());
        }
        return 0.0;
    }

    void checkRoom(double entries, PlyType type) const {
        const std::size_t room = rest_.size() / sizeOf(type); // in whole entries
        if (entries > static_cast<double>(room)) {
            place_.refuse("the file ends here");
        }
    }

  private:
    template <class Bits>
    Bits bits() {
        if (rest_.size() < sizeof(Bits)) {
            place_.refuse("the file ends here");
        }
        const auto value = storedNumber<Bits, order>(rest_.data());
        rest_.remove_prefix(sizeof value);
        return value;
    }

    std::string_view rest_;
    const PlyPlace& place_;
};

} // namespace metamarch
