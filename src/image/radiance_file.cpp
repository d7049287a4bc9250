// SPDX-License-Identifier: MIT
// The format is described in Radiance's "File Formats" by Greg Ward, and in color.c of its source.
#include "metamarch/image/radiance_file.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace metamarch {
namespace {

using Pixel = std::array<unsigned char, 4>; // three mantissas and an exponent

// The old coding makes 255 pixels of 4 bytes, and more from a second such run on. Pictures in use stay below
// this; a header that claims more is not believed.
constexpr std::uint64_t kMostPixelsOfOneByte = 4096;
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28; // as many as a texture may have

// The picture is stored as `count` scanlines of `length` pixels. An axis runs with its letter's direction, x
// to the right and y upwards, or against it.
struct Layout {
    bool isByColumns = false; // scanlines are columns
    int count = 0;
    int length = 0;
    bool isLeftwards = false;
    bool isUpwards = false;

    int width() const { return isByColumns ? count : length; }
    int height() const { return isByColumns ? length : count; }
};

std::string_view trimmed(std::string_view text) {
    constexpr const char* kBlanks = " \t";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin != std::string_view::npos ? text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1)
                                           : std::string_view();
}

class RadianceReader {
  public:
    RadianceReader(std::span<const unsigned char> bytes, const std::filesystem::path& path)
        : rest_(bytes), size_(bytes.size()), path_(path) {}

    Image read() {
        readHeader();
        const Layout layout = readLayout(line("its resolution"));
        std::vector<Pixel> pixels;
        for (int i = 0; i < layout.count; ++i) {
            readScanline(pixels, static_cast<std::size_t>(layout.length), i);
        }
        return place(pixels, layout);
    }

  private:
    [[noreturn]] void refuse(const std::string& reason) const {
        throw Error(ErrorKind::inputRefused, "cannot read " + path_.string() + ": " + reason);
    }

    std::string line(const char* what) {
        const auto end = std::ranges::find(rest_, '\n');
        if (end == rest_.end()) {
            refuse(fmt::format("it is cut off before {}", what));
        }
        const auto length = static_cast<std::size_t>(end - rest_.begin());
        std::string text(rest_.begin(), end);
        if (text.ends_with('\r')) {
            text.pop_back();
        }
        rest_ = rest_.subspan(length + 1);
        return text;
    }

    // The header ends at an empty line.
    void readHeader() {
        constexpr std::string_view kFormat = "FORMAT=";
        for (std::string text = line("its header"); !text.empty(); text = line("the end of its header")) {
            if (!text.starts_with(kFormat)) {
                continue;
            }
            const std::string_view format = trimmed(std::string_view(text).substr(kFormat.size()));
            if (format != "32-bit_rle_rgbe" && format != "32-bit_rle_xyze") {
                refuse(fmt::format("its format '{:.40}' is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze",
                                   format));
            }
            isXyz_ = format == "32-bit_rle_xyze";
        }
    }

    // Parses "-Y 512 +X 1024": the slower axis first, each with the direction in which it runs.
    Layout readLayout(const std::string& text) const {
        struct Axis {
            bool isNegative;
            char name;
            int size;
        };
        std::string_view left = text;
        const auto axis = [&left]() -> std::optional<Axis> {
            left.remove_prefix(std::min(left.find_first_not_of(' '), left.size()));
            if (left.size() < 4 || (left[0] != '-' && left[0] != '+') || left[2] != ' ') {
                return std::nullopt;
            }
            Axis parsed{left[0] == '-', left[1], 0};
            left.remove_prefix(std::min(left.find_first_not_of(' ', 2), left.size()));
            const auto [end, failure] = std::from_chars(left.data(), left.data() + left.size(), parsed.size);
            left.remove_prefix(static_cast<std::size_t>(end - left.data()));
            return failure == std::errc() && parsed.size > 0 ? std::optional(parsed) : std::nullopt;
        };
        const std::optional<Axis> slow = axis();
        const std::optional<Axis> fast = axis();
        const bool areAxes =
            slow && fast &&
            ((slow->name == 'Y' && fast->name == 'X') || (slow->name == 'X' && fast->name == 'Y'));
        if (!areAxes) {
            refuse(fmt::format("its resolution '{:.40}' is not of the form '-Y height +X width'", text));
        }
        const std::uint64_t pixels =
            static_cast<std::uint64_t>(slow->size) * static_cast<std::uint64_t>(fast->size);
        if (pixels > std::min(kMaxPixels, kMostPixelsOfOneByte * size_)) {
            refuse(
                fmt::format("{} x {} pixels are more than {} bytes can hold", slow->size, fast->size, size_));
        }
        const bool isByColumns = slow->name == 'X';
        const Axis& x = isByColumns ? *slow : *fast;
        const Axis& y = isByColumns ? *fast : *slow;
        return {isByColumns, slow->size, fast->size, x.isNegative, !y.isNegative};
    }

    unsigned char byte(int scanline) {
        if (rest_.empty()) {
            refuse(fmt::format("it is cut off in scanline {}", scanline));
        }
        const unsigned char value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }

    // A scanline starts with 2, 2 and its length where each component is coded apart. An exponent of the
    // other codings never makes these.
    void readScanline(std::vector<Pixel>& pixels, std::size_t length, int scanline) {
        const std::size_t begin = pixels.size();
        if (rest_.size() < 4 || rest_[0] != 2 || rest_[1] != 2 || rest_[2] >= 128) {
            readPixels(pixels, begin + length, scanline);
            return;
        }
        if (static_cast<std::size_t>(rest_[2]) * 256 + rest_[3] != length) {
            refuse(fmt::format("scanline {} has another length than the header says", scanline));
        }
        rest_ = rest_.subspan(4);
        pixels.resize(begin + length);
        for (std::size_t component = 0; component < 4; ++component) {
            readComponent(std::span(pixels).subspan(begin), component, scanline);
        }
    }

    void readComponent(std::span<Pixel> pixels, std::size_t component, int scanline) {
        for (std::size_t i = 0; i < pixels.size();) {
            const std::size_t code = byte(scanline);
            const bool isRun = code > 128;
            const std::size_t count = isRun ? code - 128 : code;
            if (count == 0 || count > pixels.size() - i) {
                refuse(fmt::format("scanline {} is broken", scanline));
            }
            const unsigned char repeated = isRun ? byte(scanline) : static_cast<unsigned char>(0);
            for (const std::size_t end = i + count; i < end; ++i) {
                pixels[i][component] = isRun ? repeated : byte(scanline);
            }
        }
    }

    // Reads pixel by pixel. Mantissas of 1, 1, 1 repeat the last pixel as often as the exponent says; runs in
    // a row are the digits of a number to base 256, lowest first.
    void readPixels(std::vector<Pixel>& pixels, std::size_t end, int scanline) {
        const std::size_t begin = pixels.size();
        for (unsigned shift = 0; pixels.size() < end;) {
            Pixel pixel{};
            for (unsigned char& component : pixel) {
                component = byte(scanline);
            }
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                pixels.push_back(pixel);
                shift = 0;
                continue;
            }
            const std::uint64_t count = shift < 32 ? std::uint64_t{pixel[3]} << shift : ~std::uint64_t{0};
            if (pixels.size() == begin || count > end - pixels.size()) {
                refuse(fmt::format("scanline {} is broken", scanline));
            }
            pixels.insert(pixels.end(), count, Pixel(pixels.back()));
            shift += 8;
        }
    }

    std::array<float, 3> color(const Pixel& pixel) const {
        // The exponent's bias is 128, and the mantissas count 256ths. 0 is black.
        const float scale = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, int{pixel[3]} - 136);
        const std::array<float, 3> stored = {scale * static_cast<float>(pixel[0]),
                                             scale * static_cast<float>(pixel[1]),
                                             scale * static_cast<float>(pixel[2])};
        if (!isXyz_) {
            return stored;
        }
        // The inverse of the matrix that Rec. ITU-R BT.709's primaries and white make.
        constexpr float kFromXyz[3][3] = {{3.2409699f, -1.5373832f, -0.4986108f},
                                          {-0.9692436f, 1.8759675f, 0.0415551f},
                                          {0.0556301f, -0.2039770f, 1.0569715f}};
        std::array<float, 3> result{};
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 3; ++column) {
                result[row] += kFromXyz[row][column] * stored[column];
            }
        }
        return result;
    }

    Image place(const std::vector<Pixel>& pixels, const Layout& layout) const {
        Image image(layout.width(), layout.height(), {"R", "G", "B"});
        for (int slow = 0, i = 0; slow < layout.count; ++slow) {
            for (int fast = 0; fast < layout.length; ++fast, ++i) {
                const int alongX = layout.isByColumns ? slow : fast;
                const int alongY = layout.isByColumns ? fast : slow;
                const int x = layout.isLeftwards ? layout.width() - 1 - alongX : alongX;
                const int y = layout.isUpwards ? layout.height() - 1 - alongY : alongY;
                const std::array<float, 3> texel = color(pixels[static_cast<std::size_t>(i)]);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    image.at(x, y, channel) = texel[channel];
                }
            }
        }
        return image;
    }

    std::span<const unsigned char> rest_;
    std::size_t size_;
    const std::filesystem::path& path_;
    bool isXyz_ = false;
};

} // namespace

bool isRadiance(std::span<const unsigned char> bytes) {
    return bytes.size() >= 2 && bytes[0] == '#' && bytes[1] == '?';
}

Image readRadiance(std::span<const unsigned char> bytes, const std::filesystem::path& path) {
    return RadianceReader(bytes, path).read();
}

} // namespace metamarch
