// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_check.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace metamarch {
namespace {

enum class Encoding { text, littleEndian, bigEndian };

struct Type {
    int size = 0;
    bool isFloat = false;
    bool isSigned = false;
};

struct Property {
    std::string name;
    Type type;
    std::optional<Type> listCount; // set for a list
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
    std::size_t size = 0; // number of bytes before the body

    std::uint64_t count(std::string_view name) const {
        const auto found = std::ranges::find(elements, name, &Element::name);
        return found != elements.end() ? found->count : 0;
    }
};

Type typeNamed(const InputFile& file, const std::string& name) {
    if (name == "char" || name == "int8") {
        return {1, false, true};
    }
    if (name == "uchar" || name == "uint8") {
        return {1, false, false};
    }
    if (name == "short" || name == "int16") {
        return {2, false, true};
    }
    if (name == "ushort" || name == "uint16") {
        return {2, false, false};
    }
    if (name == "int" || name == "int32") {
        return {4, false, true};
    }
    if (name == "uint" || name == "uint32") {
        return {4, false, false};
    }
    if (name == "float" || name == "float32") {
        return {4, true, true};
    }
    if (name == "double" || name == "float64") {
        return {8, true, true};
    }
    file.refuse("PLY header: unknown type '" + name + "'");
}

class HeaderReader {
  public:
    HeaderReader(const InputFile& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    Header read() {
        if (nextLine() != "ply") {
            file_.refuse("not PLY: does not start with 'ply'");
        }
        while (true) {
            const std::string line = nextLine();
            if (line == "end_header") {
                break;
            }
            std::istringstream words(line);
            std::string keyword;
            words >> keyword;
            if (keyword == "format") {
                readFormat(words);
            } else if (keyword == "element") {
                readElement(words);
            } else if (keyword == "property") {
                readProperty(words);
            }
        }
        return std::move(header_);
    }

  private:
    std::string nextLine() {
        const std::size_t end = bytes_.find('\n', header_.size);
        if (end == std::string_view::npos) {
            file_.refuse("not PLY, or cut off in its header");
        }
        std::string line(bytes_.substr(header_.size, end - header_.size));
        header_.size = end + 1;
        line.erase(line.find_last_not_of(" \t\r") + 1);
        return line;
    }

    void readFormat(std::istringstream& words) {
        std::string format;
        words >> format;
        if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
            file_.refuse("PLY header: unknown format '" + format + "'");
        }
        if (format != "ascii") {
            header_.encoding = format == "binary_big_endian" ? Encoding::bigEndian : Encoding::littleEndian;
        }
    }

    void readElement(std::istringstream& words) {
        Element element;
        std::int64_t count = -1;
        words >> element.name >> count;
        // An element takes at least one byte. This check prevents work on billions of elements that do not
        // exist.
        if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size()) {
            file_.refuse("PLY header: the file cannot hold its elements '" + element.name + "'");
        }
        element.count = static_cast<std::uint64_t>(count);
        header_.elements.push_back(std::move(element));
    }

    void readProperty(std::istringstream& words) {
        Property property;
        std::string type, countType;
        words >> type;
        if (type == "list") {
            words >> countType >> type;
            property.listCount = typeNamed(file_, countType);
        }
        property.type = typeNamed(file_, type);
        if (!(words >> property.name) || header_.elements.empty()) {
            file_.refuse("PLY header: a property without a name or element");
        }
        if (property.listCount && (property.listCount->isFloat || property.type.isFloat)) {
            file_.refuse("PLY header: list '" + property.name + "' is not of integers");
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    const InputFile& file_;
    std::string_view bytes_;
    Header header_;
};

class BodyChecker {
  public:
    BodyChecker(const InputFile& file, const Header& header, std::string_view body)
        : file_(file), header_(header), rest_(body) {}

    void check() {
        for (const Element& element : header_.elements) {
            for (std::uint64_t i = 0; i < element.count; ++i) {
                at_ = &element;
                index_ = i;
                beginElement();
                for (const Property& property : element.properties) {
                    checkProperty(property);
                }
            }
        }
    }

  private:
    void checkProperty(const Property& property) {
        if (!property.listCount) {
            readNumber(property.type);
            return;
        }
        const double entries = readNumber(*property.listCount);
        if (!(entries >= 0.0)) {
            refuse("a list has " + std::to_string(static_cast<std::int64_t>(entries)) + " entries");
        }
        const bool indexesVertices = property.name == "vertex_indices" || property.name == "vertex_index";
        for (double entry = 0.0; entry < entries; ++entry) {
            const double value = readNumber(property.type);
            if (indexesVertices && !(value >= 0.0 && value < static_cast<double>(header_.count("vertex")))) {
                refuse("vertex index " + std::to_string(static_cast<std::int64_t>(value)) +
                       " is out of range, there are " + std::to_string(header_.count("vertex")) +
                       " vertices");
            }
        }
    }

    double readNumber(const Type& type) {
        return header_.encoding == Encoding::text ? readWord() : readBytes(type);
    }

    // Assimp reads each element of a text file from its own line. Do the same, so that both agree.
    void beginElement() {
        if (header_.encoding != Encoding::text) {
            return;
        }
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
        if (rest_.empty()) {
            refuse("the file ends here");
        }
        line_ = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(line_.size());
    }

    double readWord() {
        line_.remove_prefix(std::min(line_.find_first_not_of(" \t\r"), line_.size()));
        if (line_.starts_with('+')) {
            line_.remove_prefix(1);
        }
        if (line_.empty()) {
            refuse("the line ends here");
        }
        double number = 0.0;
        const auto [end, failure] = std::from_chars(line_.data(), line_.data() + line_.size(), number);
        // result_out_of_range means a well-formed number that is too small or too large for a double.
        if (failure == std::errc::invalid_argument) {
            refuse("not a number");
        }
        line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
        return number;
    }

    double readBytes(const Type& type) {
        const auto size = static_cast<std::size_t>(type.size);
        if (rest_.size() < size) {
            refuse("the file ends here");
        }
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t from = header_.encoding == Encoding::bigEndian ? i : size - 1 - i;
            bits = bits << 8 | static_cast<unsigned char>(rest_[from]);
        }
        rest_.remove_prefix(size);
        // Only integers are checked here: Assimp reads the floats, and the scene checks them.
        if (type.isFloat) {
            return 0.0;
        }
        const auto unused = static_cast<int>(64 - 8 * size);
        return type.isSigned ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                             : static_cast<double>(bits);
    }

    [[noreturn]] void refuse(const std::string& what) const {
        file_.refuse("PLY " + at_->name + ' ' + std::to_string(index_) + ": " + what);
    }

    const InputFile& file_;
    const Header& header_;
    std::string_view rest_;
    std::string_view line_; // text only: the rest of the element's line
    const Element* at_ = nullptr;
    std::uint64_t index_ = 0;
};

} // namespace

MeshCounts checkPly(const InputFile& file, std::string_view bytes) {
    const Header header = HeaderReader(file, bytes).read();
    BodyChecker(file, header, bytes.substr(header.size)).check();
    return {header.count("vertex"), header.count("face")};
}

} // namespace metamarch
