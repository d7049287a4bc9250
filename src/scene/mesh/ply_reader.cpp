// SPDX-License-Identifier: MIT
#include "metamarch/scene/instance_writer.h"
#include "metamarch/scene/mesh/companion_name.h"
#include "metamarch/scene/mesh/mesh_reader.h"
#include "metamarch/scene/mesh/name_list.h"
#include "metamarch/scene/mesh/ply_body.h"
#include "metamarch/scene/mesh/ply_header.h"
#include "metamarch/scene/mesh/text_form.h"
#include "metamarch/scene/mesh/vertex_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <unordered_map>

namespace metamarch {
namespace {

// What is read of an element, besides the lists of faces.
enum Slot : std::size_t {
    kX,
    kY,
    kZ,
    kNormalX,
    kNormalY,
    kNormalZ,
    kRed,
    kGreen,
    kBlue,
    kAlpha,
    kU,
    kV,
    kTextureNumber,
    kSlotCount,
};
constexpr std::size_t kNoSlot = kSlotCount;

struct SlotName {
    std::string_view name;
    Slot slot;
};

// The names of colours, for vertices and faces.
constexpr auto kColorSlots = std::to_array<SlotName>({
    {"red", kRed},
    {"green", kGreen},
    {"blue", kBlue},
    {"alpha", kAlpha},
    {"diffuse_red", kRed},
    {"diffuse_green", kGreen},
    {"diffuse_blue", kBlue},
});

constexpr auto kVertexSlots = std::to_array<SlotName>({
    {"x", kX},
    {"y", kY},
    {"z", kZ},
    {"nx", kNormalX},
    {"ny", kNormalY},
    {"nz", kNormalZ},
    {"r", kRed},
    {"g", kGreen},
    {"b", kBlue},
    {"a", kAlpha},
    {"u", kU},
    {"v", kV},
    {"s", kU},
    {"t", kV},
    {"texture_u", kU},
    {"texture_v", kV},
});

constexpr auto kFaceSlots = std::to_array<SlotName>({
    {"texnumber", kTextureNumber},
});

// Where the scalar properties of an element go. If two go to the same place, the first does.
class Slots {
  public:
    Slots(const PlyElement& element, std::span<const SlotName> names)
        : of_(element.properties.size(), kNoSlot) {
        for (std::size_t i = 0; i < of_.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const std::size_t slot = std::min(slotOf(names, property), slotOf(kColorSlots, property));
            if (slot == kNoSlot || has_[slot]) {
                continue;
            }
            of_[i] = slot;
            has_[slot] = true;
            areFractions_ = areFractions_ || (slot == kRed && isFraction(property.type));
        }
    }

    std::size_t of(std::size_t property) const { return of_[property]; }
    bool has(Slot slot) const { return has_[slot]; }
    bool hasNormals() const { return has(kNormalX) && has(kNormalY) && has(kNormalZ); }
    bool hasColors() const { return has(kRed) && has(kGreen) && has(kBlue); }
    bool hasTexCoords() const { return has(kU) && has(kV); }
    bool colorsAreFractions() const { return areFractions_; }

  private:
    // Returns kNoSlot, the largest, for a list and for a name that is not there.
    static std::size_t slotOf(std::span<const SlotName> names, const PlyProperty& property) {
        const auto found = std::ranges::find(names, property.name, &SlotName::name);
        return property.countType || found == names.end() ? kNoSlot : found->slot;
    }

    std::vector<std::size_t> of_;
    std::array<bool, kSlotCount> has_{};
    bool areFractions_ = false;
};

void addColor(FileColors& colors, const std::array<double, kSlotCount>& values, const Slots& slots) {
    const auto alpha = static_cast<float>(values[kAlpha]);
    colors.add(glm::vec3(values[kRed], values[kGreen], values[kBlue]),
               slots.has(kAlpha) ? std::optional(alpha) : std::nullopt);
}

bool isIndexList(const PlyProperty& property) {
    return property.countType && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// What the body holds.
struct Content {
    PolygonMesh mesh;
    std::vector<glm::vec2> texCoordsOfVertices;
    FileColors colorsOfVertices;
    FileColors colorsOfFaces;
    std::vector<std::uint32_t> textureOfFace; // kNoIndex: none
    // The faces of the element `face` are one after another; `firstFace` is the first.
    std::size_t firstFace = 0;
    std::size_t faceCount = 0;
    std::vector<std::uint32_t> grid; // row by row: the vertex of each place, or kNoIndex
    NameList skipped;                // "3 'edge'"
    std::uint64_t facesWithoutTexCoords = 0;
};

template <class Body>
class BodyReader {
  public:
    BodyReader(const InputFile& file, const PlyHeader& header, PlyPlace& place, Body& body)
        : file_(file), header_(header), place_(place), body_(body) {
        const PlyElement* vertices = header.find("vertex");
        vertexCount_ = vertices == nullptr ? 0 : vertices->count;
    }

    Content read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                readVertices(element);
            } else if (element.name == "face") {
                readFaces(element);
            } else if (element.name == "tristrips") {
                readStrips(element);
            } else if (element.name == "range_grid") {
                readGrid(element);
            } else {
                skip(element);
            }
        }
        return std::move(content_);
    }

  private:
    template <class Visit>
    void forEach(const PlyElement& element, const Visit& visit) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            place_.set(element, i);
            body_.beginElement();
            visit();
        }
    }

    template <class Visit>
    void readList(const PlyProperty& property, const Visit& visit) {
        const double entries = body_.read(*property.countType);
        if (!(entries >= 0.0)) {
            place_.refuse(fmt::format("a list has {} entries", entries));
        }
        body_.checkRoom(entries, property.type);
        for (double entry = 0.0; entry < entries; ++entry) {
            visit(body_.read(property.type));
        }
    }

    void readVertices(const PlyElement& element) {
        const Slots slots(element, kVertexSlots);
        if (!slots.has(kX) || !slots.has(kY) || !slots.has(kZ)) {
            file_.refuse("PLY header: the vertices do not have x, y and z");
        }
        PolygonMesh& mesh = content_.mesh;
        mesh.positions.reserve(element.count);
        content_.colorsOfVertices.setFractions(slots.colorsAreFractions());
        std::array<double, kSlotCount> values{};
        forEach(element, [&] {
            readScalars(element, slots, values);
            mesh.positions.emplace_back(values[kX], values[kY], values[kZ]);
            if (slots.hasNormals()) {
                mesh.normals.emplace_back(values[kNormalX], values[kNormalY], values[kNormalZ]);
            }
            if (slots.hasTexCoords()) {
                content_.texCoordsOfVertices.emplace_back(values[kU], 1.0 - values[kV]); // v points up
            }
            if (slots.hasColors()) {
                addColor(content_.colorsOfVertices, values, slots);
            }
        });
    }

    void readScalars(const PlyElement& element, const Slots& slots, std::array<double, kSlotCount>& values) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.countType) {
                readList(property, [](double) {});
            } else if (const double value = body_.read(property.type); slots.of(i) != kNoSlot) {
                values[slots.of(i)] = value;
            }
        }
    }

    // A vertex of a face that has coordinates of its own, as MeshLab writes them: u and v for each corner.
    void readFaces(const PlyElement& element) {
        const Slots slots(element, kFaceSlots);
        const PlyProperty* indices = listOfIndices(element);
        const auto texCoords = std::ranges::find_if(element.properties, [](const PlyProperty& property) {
            return property.countType && property.name == "texcoord";
        });
        content_.colorsOfFaces.setFractions(slots.colorsAreFractions());
        content_.firstFace = content_.mesh.faceEnd.size();
        content_.faceCount = element.count;
        content_.mesh.faceEnd.reserve(content_.firstFace + element.count);
        std::array<double, kSlotCount> values{};
        std::vector<float> coordinates;
        forEach(element, [&] {
            const std::size_t begin = content_.mesh.cornerPosition.size();
            coordinates.clear();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (&property == indices) {
                    readList(property,
                             [&](double index) { content_.mesh.cornerPosition.push_back(vertex(index)); });
                } else if (texCoords != element.properties.end() && &property == &*texCoords) {
                    readList(property,
                             [&](double value) { coordinates.push_back(static_cast<float>(value)); });
                } else if (property.countType) {
                    readList(property, [](double) {});
                } else if (const double value = body_.read(property.type); slots.of(i) != kNoSlot) {
                    values[slots.of(i)] = value;
                }
            }
            endFace(file_, content_.mesh);
            if (texCoords != element.properties.end()) {
                addTexCoords(begin, coordinates);
            }
            if (slots.has(kTextureNumber)) {
                content_.textureOfFace.push_back(textureNumbered(values[kTextureNumber]));
            }
            if (slots.hasColors()) {
                addColor(content_.colorsOfFaces, values, slots);
            }
        });
    }

    // Returns null if the element is empty: then nobody misses the list.
    const PlyProperty* listOfIndices(const PlyElement& element) const {
        const auto found = std::ranges::find_if(element.properties, isIndexList);
        if (found != element.properties.end()) {
            return &*found;
        }
        if (element.count > 0) {
            file_.refuse("PLY header: " + element.name + " has no list 'vertex_indices'");
        }
        return nullptr;
    }

    // `coordinates` belong to the corners from `begin` on.
    void addTexCoords(std::size_t begin, const std::vector<float>& coordinates) {
        PolygonMesh& mesh = content_.mesh;
        const std::size_t end = mesh.cornerPosition.size();
        mesh.cornerTexCoord.resize(begin, kNoIndex);
        if (coordinates.size() != 2 * (end - begin)) {
            ++content_.facesWithoutTexCoords;
            mesh.cornerTexCoord.resize(end, kNoIndex);
            return;
        }
        for (std::size_t i = 0; i < coordinates.size(); i += 2) {
            mesh.cornerTexCoord.push_back(static_cast<std::uint32_t>(mesh.texCoords.size()));
            mesh.texCoords.emplace_back(coordinates[i], 1.0f - coordinates[i + 1]);
        }
    }

    std::uint32_t textureNumbered(double number) const {
        const bool exists = number >= 0.0 && number < static_cast<double>(header_.textureFiles.size());
        return exists ? static_cast<std::uint32_t>(number) : kNoIndex;
    }

    void readStrips(const PlyElement& element) {
        const PlyProperty* indices = listOfIndices(element);
        std::uint32_t a = kNoIndex;
        std::uint32_t b = kNoIndex;
        bool isOdd = false;
        const auto restart = [&] {
            a = b = kNoIndex;
            isOdd = false;
        };
        const auto addVertex = [&](double value) {
            if (value == -1.0 || value == double{0xffffffffu}) {
                restart();
                return;
            }
            const std::uint32_t c = vertex(value);
            if (a != kNoIndex) {
                addTriangle(isOdd ? b : a, isOdd ? a : b, c);
                isOdd = !isOdd;
            }
            a = b;
            b = c;
        };
        forEach(element, [&] {
            restart();
            for (const PlyProperty& property : element.properties) {
                if (&property == indices) {
                    readList(property, addVertex);
                } else {
                    skip(property);
                }
            }
        });
    }

    // A strip that repeats a vertex does so to go on elsewhere.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) {
            content_.mesh.cornerPosition.insert(content_.mesh.cornerPosition.end(), {a, b, c});
            endFace(file_, content_.mesh);
        }
    }

    // Each place of the grid has a list of one vertex, or an empty list where the scanner saw nothing.
    void readGrid(const PlyElement& element) {
        const PlyProperty* indices = listOfIndices(element);
        content_.grid.reserve(element.count);
        forEach(element, [&] {
            content_.grid.push_back(kNoIndex);
            for (const PlyProperty& property : element.properties) {
                if (&property == indices) {
                    readList(property, [&](double index) { content_.grid.back() = vertex(index); });
                } else {
                    skip(property);
                }
            }
        });
    }

    void skip(const PlyElement& element) {
        if (element.properties.empty() || element.count == 0) {
            return;
        }
        forEach(element, [&] {
            for (const PlyProperty& property : element.properties) {
                skip(property);
            }
        });
        content_.skipped.add(std::to_string(element.count) + ' ' + inQuotes(element.name));
    }

    void skip(const PlyProperty& property) {
        if (property.countType) {
            readList(property, [](double) {});
        } else {
            body_.read(property.type);
        }
    }

    std::uint32_t vertex(double value) const {
        if (value >= 0.0 && value < static_cast<double>(vertexCount_)) {
            const auto index = static_cast<std::uint32_t>(value);
            if (static_cast<double>(index) == value) {
                return index;
            }
        }
        place_.refuse(
            fmt::format("vertex index {} is out of range, there are {} vertices", value, vertexCount_));
    }

    const InputFile& file_;
    const PlyHeader& header_;
    PlyPlace& place_;
    Body& body_;
    std::uint64_t vertexCount_ = 0;
    Content content_;
};

void warnOfBytesAfterElements(InputFile& file, std::size_t bytes) {
    if (bytes > 0) {
        file.warn("PLY: " + std::to_string(bytes) + " bytes after the last element are not read");
    }
}

template <std::endian order>
Content readBinary(InputFile& file, const PlyHeader& header) {
    PlyPlace place(file);
    PlyBinaryBody<order> body(header.body, place);
    Content content = BodyReader(file, header, place, body).read();
    warnOfBytesAfterElements(file, body.finish());
    return content;
}

// Read by words, the last word has to be the last number.
Content readText(InputFile& file, const PlyHeader& header) {
    return readLinesElseWords([&](const bool isFreeForm) {
        PlyPlace place(file);
        PlyTextBody body(header.body, place, isFreeForm);
        Content content = BodyReader(file, header, place, body).read();
        if (isFreeForm) {
            if (!body.isAtEnd()) {
                place.refuse("there are words behind the last number");
            }
            file.warn("PLY: the elements are not each on a line of their own");
            return content;
        }
        const std::size_t trailingBytes = body.finish();
        if (body.longLines() > 0) {
            file.warn("PLY: " + std::to_string(body.longLines()) +
                      " lines have more numbers than their elements; these are not read");
        }
        warnOfBytesAfterElements(file, trailingBytes);
        return content;
    });
}

Content readContent(InputFile& file, const PlyHeader& header) {
    switch (header.encoding) {
    case PlyEncoding::littleEndian:
        return readBinary<std::endian::little>(file, header);
    case PlyEncoding::bigEndian:
        return readBinary<std::endian::big>(file, header);
    default:
        return readText(file, header);
    }
}

// Range scans of Stanford: neighbours in the grid are neighbours on the surface. A square is divided along
// its shorter diagonal; one that lacks a corner is one triangle.
void addGrid(const InputFile& file, const PlyHeader& header, Content& content) {
    if (content.grid.empty()) {
        return;
    }
    const std::uint64_t columns = header.gridColumns.value_or(0);
    const std::uint64_t rows = header.gridRows.value_or(0);
    if (columns == 0 || content.grid.size() % columns != 0 || content.grid.size() / columns != rows) {
        file.refuse(
            fmt::format("PLY: obj_info gives the range grid {} columns and {} rows, but it has {} places",
                        columns, rows, content.grid.size()));
    }
    PolygonMesh& mesh = content.mesh;
    for (std::uint64_t row = 1; row < rows; ++row) {
        for (std::uint64_t column = 1; column < columns; ++column) {
            const std::uint64_t place = row * columns + column;
            std::array<std::uint32_t, 4> square = {content.grid[place - columns - 1],
                                                   content.grid[place - columns], content.grid[place],
                                                   content.grid[place - 1]};
            const auto diagonal = [&](std::size_t a, std::size_t b) {
                return glm::distance(mesh.positions[square[a]], mesh.positions[square[b]]);
            };
            const auto end = std::remove(square.begin(), square.end(), kNoIndex);
            const auto corners = static_cast<std::size_t>(end - square.begin());
            const auto add = [&](std::initializer_list<std::size_t> triangle) {
                for (const std::size_t corner : triangle) {
                    mesh.cornerPosition.push_back(square[corner]);
                }
                endFace(file, mesh);
            };
            if (corners == 3) {
                add({0, 1, 2});
            } else if (corners == 4 && diagonal(1, 3) < diagonal(0, 2)) {
                add({0, 1, 3});
                add({1, 2, 3});
            } else if (corners == 4) {
                add({0, 1, 2});
                add({0, 2, 3});
            }
        }
    }
}

void checkFaces(const InputFile& file, const PlyHeader& header, const PolygonMesh& mesh) {
    if (mesh.positions.empty()) {
        file.refuse("PLY: there are no vertices");
    }
    if (mesh.faceEnd.empty()) {
        const PlyElement* edges = header.find("edge");
        const std::string alsoEdges =
            edges != nullptr && edges->count > 0 ? " and " + std::to_string(edges->count) + " edges" : "";
        file.refuse("PLY: there are " + std::to_string(mesh.positions.size()) + " vertices" + alsoEdges +
                    ", but no faces; points and edges are not rendered");
    }
}

void warn(InputFile& file, const Content& content) {
    if (!content.skipped.empty()) {
        file.warn("PLY: elements are not read: " + content.skipped.text());
    }
    if (content.facesWithoutTexCoords > 0) {
        file.warn("PLY: " + std::to_string(content.facesWithoutTexCoords) +
                  " faces do not have one texture coordinate for each corner; zero is used");
    }
}

void addTextures(InputFile& file, const PlyHeader& header, Content& content, MeshFile& result) {
    if (header.textureFiles.empty()) {
        return;
    }
    PolygonMesh& mesh = content.mesh;
    if (mesh.texCoords.empty()) {
        file.warn("PLY: there are no texture coordinates, so the texture " +
                  inQuotes(header.textureFiles[0]) + " is not used");
        return;
    }
    constexpr std::size_t kMostTextures = 1000; // each is looked for in several places
    std::vector<std::uint32_t> materialOfNumber;
    std::unordered_map<std::string, std::uint32_t> materialOfName;
    for (const std::string& given : header.textureFiles) {
        if (const auto found = materialOfName.find(given); found != materialOfName.end()) {
            materialOfNumber.push_back(found->second);
            continue;
        }
        if (materialOfName.size() == kMostTextures) {
            file.warn("PLY: there are more than " + std::to_string(kMostTextures) +
                      " texture files; the others are not used");
            break;
        }
        materialOfNumber.push_back(static_cast<std::uint32_t>(result.materials.size()));
        materialOfName.emplace(given, materialOfNumber.back());
        const std::string name = companionName(file, "", given);
        Material material = vertexColorMaterial({});
        material.baseColorTexture.texture = static_cast<std::uint32_t>(result.textures.size());
        material.baseColorTexture.isSrgb = true;
        material.name = name;
        result.materials.push_back(std::move(material));
        result.textures.push_back({.image = static_cast<std::uint32_t>(result.textures.size())});
        result.textureSources.push_back({imageFile(file, name)});
    }
    mesh.faceMaterial.assign(mesh.faceEnd.size(), content.textureOfFace.empty() ? 0 : kNoIndex);
    std::ranges::transform(content.textureOfFace,
                           mesh.faceMaterial.begin() + static_cast<std::ptrdiff_t>(content.firstFace),
                           [&](std::uint32_t number) {
                               return number < materialOfNumber.size() ? materialOfNumber[number] : kNoIndex;
                           });
    if (const auto without = std::ranges::count(content.textureOfFace, kNoIndex); without > 0) {
        file.warn("PLY: " + std::to_string(without) + " faces have a texture number without a file");
    }
}

void addColors(InputFile& file, Content& content, MeshFile& result) {
    PolygonMesh& mesh = content.mesh;
    const bool haveVertices = !content.colorsOfVertices.empty();
    if (!haveVertices && content.colorsOfFaces.empty()) {
        return;
    }
    if (!result.textures.empty()) {
        // MeshLab writes both, for the same surface.
        file.warn("PLY: the file has textures, so its colours are not used");
        return;
    }
    if (haveVertices) {
        mesh.colors = content.colorsOfVertices.decoded();
    } else {
        mesh.colors = content.colorsOfFaces.decoded();
        mesh.cornerColor.assign(mesh.cornerPosition.size(), kNoIndex);
        for (std::size_t i = 0; i < content.faceCount; ++i) {
            const std::size_t face = content.firstFace + i;
            const std::uint32_t begin = face == 0 ? 0 : mesh.faceEnd[face - 1];
            std::fill(mesh.cornerColor.begin() + begin, mesh.cornerColor.begin() + mesh.faceEnd[face],
                      static_cast<std::uint32_t>(i));
        }
    }
}

} // namespace

MeshFile readPly(InputFile& file, std::string_view bytes) {
    const PlyHeader header = readPlyHeader(file, bytes);
    if (const PlyElement* vertices = header.find("vertex");
        vertices != nullptr && vertices->count > kMaxVertices) {
        file.refuseSize("PLY: there are more than " + std::to_string(kMaxVertices) + " vertices");
    }
    Content content = readContent(file, header);
    addGrid(file, header, content);
    checkFaces(file, header, content.mesh);
    warn(file, content);
    PolygonMesh& mesh = content.mesh;
    if (mesh.texCoords.empty()) { // no face has coordinates of its own
        mesh.texCoords = std::move(content.texCoordsOfVertices);
        mesh.cornerTexCoord.clear();
    } else {
        mesh.cornerTexCoord.resize(mesh.cornerPosition.size(), kNoIndex);
    }
    MeshFile result;
    addTextures(file, header, content, result);
    addColors(file, content, result);
    result.polygons = std::move(content.mesh);
    return result;
}

} // namespace metamarch
