// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/ply_header.h"

#include "metamarch/scene/mesh/text_scanner.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

namespace metamarch {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

// Returns the bytes that an element takes at least. In a text that is a digit and a blank for each number.
std::uint64_t leastSize(PlyEncoding encoding, const PlyElement& element) {
    std::uint64_t size = 0;
    for (const PlyProperty& property : element.properties) {
        size += encoding == PlyEncoding::text ? 2 : sizeOf(property.countType.value_or(property.type));
    }
    return size;
}

class HeaderReader {
  public:
    HeaderReader(const InputFile& file, std::string_view bytes)
        : file_(file), bytes_(bytes), scanner_(bytes) {}

    PlyHeader read() {
        if (!scanner_.nextLine() || scanner_.restOfLine() != "ply") {
            file_.refuse("not PLY: does not start with 'ply'");
        }
        const bool endsAtReturn = endsAtReturnAlone();
        while (true) {
            // The last line has an end too: without it, there is no saying where the body begins.
            if (scanner_.rest().find_first_of("\r\n") == std::string_view::npos) {
                file_.refuse("not PLY, or cut off in its header");
            }
            scanner_.nextLine();
            const std::string_view keyword = scanner_.nextWord();
            if (keyword == "end_header") {
                break;
            }
            readLine(keyword);
        }
        header_.body = scanner_.rest();
        // Lines that end at \r, and a body whose first byte is \n.
        if (endsAtReturn && endsAtReturnAndNewline()) {
            header_.body = std::string_view(header_.body.data() - 1, header_.body.size() + 1);
        }
        checkCounts();
        return std::move(header_);
    }

  private:
    bool endsAtReturnAlone() const { return *(scanner_.rest().data() - 1) == '\r'; }
    bool endsAtReturnAndNewline() const {
        return scanner_.rest().data()[-1] == '\n' && scanner_.rest().data()[-2] == '\r';
    }

    void readLine(std::string_view keyword) {
        if (keyword == "format") {
            readFormat();
        } else if (keyword == "element") {
            readElement();
        } else if (keyword == "property") {
            readProperty();
        } else if (keyword == "comment") {
            readComment();
        } else if (keyword == "obj_info") {
            readObjectInformation();
        } else if (!keyword.empty()) {
            refuse("unknown keyword " + inQuotes(keyword));
        }
    }

    void readFormat() {
        const std::string_view format = scanner_.nextWord();
        if (format == "binary_little_endian") {
            header_.encoding = PlyEncoding::littleEndian;
        } else if (format == "binary_big_endian") {
            header_.encoding = PlyEncoding::bigEndian;
        } else if (format != "ascii") {
            refuse("unknown format " + inQuotes(format));
        }
    }

    void readElement() {
        PlyElement element;
        element.name = scanner_.nextWord();
        const std::optional<std::int64_t> count = parseInteger(scanner_.nextWord());
        if (!count || *count < 0) {
            refuse("element " + inQuotes(element.name) + " has no count");
        }
        if (!names_.insert(element.name).second) {
            refuse("two elements are named " + inQuotes(element.name));
        }
        element.count = static_cast<std::uint64_t>(*count);
        header_.elements.push_back(std::move(element));
    }

    void readProperty() {
        PlyProperty property;
        std::string_view type = scanner_.nextWord();
        if (type == "list") {
            property.countType = typeNamed(scanner_.nextWord());
            type = scanner_.nextWord();
        }
        property.type = typeNamed(type);
        property.name = scanner_.nextWord();
        if (property.name.empty() || header_.elements.empty()) {
            refuse("a property without a name or element");
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    void readComment() {
        if (scanner_.nextWord() == "TextureFile") {
            header_.textureFiles.emplace_back(scanner_.restOfLine());
        }
    }

    void readObjectInformation() {
        const std::string_view name = scanner_.nextWord();
        if (name != "num_cols" && name != "num_rows") {
            return;
        }
        const std::optional<std::int64_t> number = parseInteger(scanner_.nextWord());
        if (number && *number >= 0) {
            (name == "num_cols" ? header_.gridColumns : header_.gridRows) =
                static_cast<std::uint64_t>(*number);
        }
    }

    PlyType typeNamed(std::string_view name) const {
        const auto found = std::ranges::find(kTypes, name, &std::pair<std::string_view, PlyType>::first);
        if (found == kTypes.end()) {
            refuse("unknown type " + inQuotes(name));
        }
        return found->second;
    }

    // Later code may allocate by a count, and may loop over it.
    void checkCounts() const {
        for (const PlyElement& element : header_.elements) {
            const std::uint64_t size = leastSize(header_.encoding, element);
            if (size > 0 && element.count > bytes_.size() / size) {
                file_.refuse("PLY header: the file cannot hold its " + std::to_string(element.count) +
                             " elements " + inQuotes(element.name));
            }
        }
    }

    [[noreturn]] void refuse(const std::string& what) const {
        file_.refuse("PLY header, line " + std::to_string(scanner_.lineNumber()) + ": " + what);
    }

    const InputFile& file_;
    std::string_view bytes_;
    TextScanner scanner_;
    PlyHeader header_;
    std::unordered_set<std::string> names_; // of elements
};

} // namespace

std::size_t sizeOf(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

const PlyElement* PlyHeader::find(std::string_view name) const {
    const auto found = std::ranges::find(elements, name, &PlyElement::name);
    return found != elements.end() ? &*found : nullptr;
}

PlyHeader readPlyHeader(const InputFile& file, std::string_view bytes) {
    return HeaderReader(file, bytes).read();
}

} // namespace metamarch
