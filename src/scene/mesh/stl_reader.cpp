// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_reader.h"
#include "metamarch/scene/mesh/text_scanner.h"
#include "metamarch/scene/mesh/vertex_color.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <string>

namespace metamarch {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

constexpr std::size_t kHeaderSize = 80;
constexpr std::size_t kCountEnd = kHeaderSize + sizeof(std::uint32_t);
constexpr std::size_t kFacetSize = 50; // normal, three positions, attribute
constexpr std::size_t kPositionsOfFacet = 12;
constexpr std::size_t kAttributeOfFacet = 48;

// The normals of facets are not read: they are those of the triangles.
class StlTextReader {
  public:
    StlTextReader(InputFile& file, std::string_view text) : file_(file), scanner_(text) {}

    PolygonMesh read() {
        for (std::string_view word = scanner_.nextWordOverLines(); !word.empty();
             word = scanner_.nextWordOverLines()) {
            if (lowerCase(word) != "solid") {
                file_.warn("STL: " + std::to_string(scanner_.bytesFrom(word)) +
                           " bytes after the last 'endsolid' are not read");
                break;
            }
            mesh_.partNames.emplace_back(scanner_.restOfLine());
            readSolid();
        }
        if (colors_ > 0) {
            file_.warn("STL: 'color', which text does not have by the definition, is skipped " +
                       std::to_string(colors_) + " times");
        }
        return std::move(mesh_);
    }

  private:
    void readSolid() {
        while (const std::optional<std::string> keyword = nextKeyword()) {
            if (*keyword == "facet") {
                readFacet();
            } else if (*keyword == "endsolid" || (*keyword == "end" && nextKeyword() == "solid")) {
                scanner_.restOfLine(); // the name, if any
                return;
            } else if (*keyword == "color") {
                skipColor();
            } else {
                refuse(inQuotes(*keyword) + " is neither 'facet' nor 'endsolid'");
            }
        }
        file_.refuse("STL text is cut off: there is no endsolid");
    }

    void skipColor() {
        for (int channel = 0; channel < 3; ++channel) {
            readNumber();
        }
        ++colors_;
    }

    void readFacet() {
        ++facet_;
        std::size_t corners = 0;
        while (const std::optional<std::string> keyword = nextKeyword()) {
            if (*keyword == "normal") {
                for (int axis = 0; axis < 3; ++axis) {
                    nextKeyword();
                }
            } else if (*keyword == "vertex") {
                mesh_.cornerPosition.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
                const float x = readNumber();
                const float y = readNumber();
                mesh_.positions.emplace_back(x, y, readNumber());
                ++corners;
            } else if (*keyword == "endfacet") {
                if (corners < 3) {
                    refuse("it has " + std::to_string(corners) + " vertices");
                }
                endFace(file_, mesh_);
                mesh_.facePart.push_back(
                    static_cast<std::uint32_t>(std::max<std::size_t>(mesh_.partNames.size(), 1) - 1));
                return;
            } else if (*keyword == "color") {
                skipColor();
            } else if (*keyword != "outer" && *keyword != "loop" && *keyword != "endloop") {
                refuse(inQuotes(*keyword) + " is neither 'vertex' nor 'endfacet'");
            }
        }
        refuse("the file ends here");
    }

    // Returns the next word of the file in lower case.
    std::optional<std::string> nextKeyword() {
        const std::string_view word = scanner_.nextWordOverLines();
        return word.empty() ? std::nullopt : std::optional(lowerCase(word));
    }

    float readNumber() {
        const std::string_view word = scanner_.nextWordOverLines();
        const std::optional<double> number = parseNumber(word);
        if (!number) {
            refuse(word.empty() ? "the file ends here" : inQuotes(word) + " is not a number");
        }
        return static_cast<float>(*number);
    }

    [[noreturn]] void refuse(const std::string& what) const {
        file_.refuse("STL line " + std::to_string(scanner_.lineNumber()) + ", facet " +
                     std::to_string(facet_) + ": " + what);
    }

    InputFile& file_;
    TextScanner scanner_;
    PolygonMesh mesh_;
    std::uint64_t colors_ = 0;
    std::uint64_t facet_ = 0; // the first is 1
};

// What programs put into the 16 bits behind a facet: five bits for each of red, green and blue.
class FacetColors {
  public:
    FacetColors(std::string_view header, std::string_view facets) {
        // Magics (Materialise) writes its default colour into the header. Bit 15 says that a facet has that
        // one.
        constexpr std::string_view kMark = "COLOR=";
        const std::size_t mark = header.find(kMark);
        if (mark != std::string_view::npos && mark + kMark.size() + 4 <= header.size()) {
            order_ = Order::redFirst;
            for (int channel = 0; channel < 3; ++channel) { // alpha is not read
                default_[channel] = static_cast<float>(static_cast<unsigned char>(
                    header[mark + kMark.size() + static_cast<std::size_t>(channel)]));
            }
            return;
        }
        // VisCAM and SolidView set bit 15 where a facet has a colour. Where a facet has other bits but not
        // this one, the attributes mean something else.
        bool hasColor = false;
        for (std::size_t at = kAttributeOfFacet; at < facets.size(); at += kFacetSize) {
            const std::uint16_t attribute = attributeAt(facets, at);
            if (attribute != 0 && (attribute & kMarkBit) == 0) {
                return;
            }
            hasColor = hasColor || attribute != 0;
        }
        order_ = hasColor ? Order::blueFirst : Order::none;
    }

    bool exist() const { return order_ != Order::none; }

    glm::vec3 of(std::string_view facets, std::size_t facet) const {
        const std::uint16_t attribute = attributeAt(facets, facet * kFacetSize + kAttributeOfFacet);
        const bool isMarked = (attribute & kMarkBit) != 0;
        if (isMarked == (order_ == Order::redFirst)) {
            return default_;
        }
        const auto channel = [attribute](int shift) {
            return static_cast<float>((attribute >> shift) & 31) * (255.0f / 31.0f);
        };
        return order_ == Order::redFirst ? glm::vec3(channel(0), channel(5), channel(10))
                                         : glm::vec3(channel(10), channel(5), channel(0));
    }

  private:
    enum class Order { none, redFirst, blueFirst };
    static constexpr std::uint16_t kMarkBit = 0x8000;

    static std::uint16_t attributeAt(std::string_view facets, std::size_t at) {
        std::uint16_t attribute = 0;
        std::memcpy(&attribute, facets.data() + at, sizeof attribute);
        return attribute;
    }

    Order order_ = Order::none;
    glm::vec3 default_{255.0f};
};

MeshFile readBinary(const InputFile& file, std::string_view bytes, std::uint32_t facetCount) {
    const std::string_view facets = bytes.substr(kCountEnd, kFacetSize * facetCount);
    MeshFile result;
    PolygonMesh& mesh = result.polygons;
    mesh.positions.resize(std::size_t{3} * facetCount);
    mesh.cornerPosition.reserve(mesh.positions.size());
    mesh.faceEnd.reserve(facetCount);
    for (std::size_t facet = 0; facet < facetCount; ++facet) {
        std::memcpy(&mesh.positions[3 * facet], facets.data() + facet * kFacetSize + kPositionsOfFacet,
                    3 * sizeof(glm::vec3));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            mesh.cornerPosition.push_back(static_cast<std::uint32_t>(3 * facet + corner));
        }
        endFace(file, mesh);
    }
    const FacetColors colors(bytes.substr(0, kHeaderSize), facets);
    if (colors.exist()) {
        FileColors fileColors;
        for (std::size_t facet = 0; facet < facetCount; ++facet) {
            fileColors.add(colors.of(facets, facet), std::nullopt);
            mesh.cornerColor.insert(mesh.cornerColor.end(), 3, static_cast<std::uint32_t>(facet));
        }
        mesh.colors = fileColors.decoded();
    }
    return result;
}

bool startsWithSolid(std::string_view bytes) {
    return lowerCase(TextScanner(bytes.substr(0, kHeaderSize)).wordOfLaterLine()) == "solid";
}

} // namespace

MeshFile readStl(InputFile& file, std::string_view bytes) {
    std::uint32_t facets = 0;
    if (bytes.size() >= kCountEnd) {
        std::memcpy(&facets, bytes.data() + kHeaderSize, sizeof facets);
    }
    // A binary header may start with "solid" too. But in a text the count is made of four characters, none of
    // them zero: so many facets have more than 7 GB, and the file's size shows that it is text.
    const std::uint64_t announced = kCountEnd + std::uint64_t{kFacetSize} * facets;
    MeshFile result;
    if (bytes.size() >= kCountEnd && announced <= bytes.size()) {
        if (facets == 0) {
            file.refuse("STL: the count of facets is 0");
        }
        result = readBinary(file, bytes, facets);
        if (announced < bytes.size()) {
            file.warn("STL: " + std::to_string(bytes.size() - announced) + " bytes after the last of " +
                      std::to_string(facets) + " facets are not read");
        }
    } else if (startsWithSolid(bytes) && bytes.substr(0, kCountEnd).find('\0') == std::string_view::npos) {
        result.polygons = StlTextReader(file, bytes).read();
    } else if (bytes.size() >= kCountEnd && bytes.substr(0, kCountEnd).find('\0') != std::string_view::npos) {
        file.refuse("STL: " + std::to_string(facets) + " facets need " + std::to_string(announced) +
                    " bytes, but the file has " + std::to_string(bytes.size()));
    } else {
        file.refuse("not STL: neither binary nor a text that starts with 'solid'");
    }
    result.repeatsPositions = true;
    return result;
}

} // namespace metamarch
