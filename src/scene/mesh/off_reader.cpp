// SPDX-License-Identifier: MIT
#include "metamarch/scene/instance_writer.h"
#include "metamarch/scene/mesh/mesh_reader.h"
#include "metamarch/scene/mesh/stored_number.h"
#include "metamarch/scene/mesh/text_form.h"
#include "metamarch/scene/mesh/text_scanner.h"
#include "metamarch/scene/mesh/vertex_color.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <string>

namespace metamarch {
namespace {

// What the letters before OFF say that a vertex has: [ST][C][N][4][n]OFF, here in any order.
struct VertexForm {
    bool hasTexCoord = false;   // ST
    bool hasColor = false;      // C
    bool hasNormal = false;     // N
    bool isHomogeneous = false; // 4
    bool hasDimension = false;  // n: the number of dimensions follows
};

std::optional<VertexForm> formNamed(std::string_view prefix) {
    VertexForm form;
    while (!prefix.empty()) {
        bool* const part = prefix[0] == 'S'   ? &form.hasTexCoord
                           : prefix[0] == 'C' ? &form.hasColor
                           : prefix[0] == 'N' ? &form.hasNormal
                           : prefix[0] == '4' ? &form.isHomogeneous
                           : prefix[0] == 'n' ? &form.hasDimension
                                              : nullptr;
        const bool isSt = prefix.starts_with("ST");
        if (part == nullptr || *part || (part == &form.hasTexCoord && !isSt)) {
            return std::nullopt;
        }
        *part = true;
        prefix.remove_prefix(isSt ? 2 : 1);
    }
    return form;
}

struct Counts {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

void checkCounts(const InputFile& file, const Counts& counts, std::uint64_t vertexSize,
                 std::uint64_t faceSize, std::uint64_t fileSize) {
    if (counts.vertices > fileSize / vertexSize || counts.faces > fileSize / faceSize) {
        file.refuse("OFF header: the file cannot hold " + std::to_string(counts.vertices) + " vertices and " +
                    std::to_string(counts.faces) + " faces");
    }
    if (counts.vertices > kMaxVertices) {
        file.refuseSize("OFF: there are more than " + std::to_string(kMaxVertices) + " vertices");
    }
}

void warnOfBytesAfterFaces(InputFile& file, std::size_t bytes) {
    file.warn("OFF: " + std::to_string(bytes) + " bytes after the last face are not read");
}

// What both encodings collect.
class OffMesh {
  public:
    OffMesh(const InputFile& file, const VertexForm& form) : file_(file), form_(form) {}

    // A vertex has no normal or texture coordinate, and no fourth number of its position, unless the form
    // says so.
    void addVertex(const float* position, const float* normal, const float* texCoord) {
        const float w = form_.isHomogeneous ? position[3] : 1.0f;
        mesh_.positions.emplace_back(position[0] / w, position[1] / w, position[2] / w);
        if (form_.hasNormal) {
            mesh_.normals.emplace_back(normal[0], normal[1], normal[2]);
        }
        if (form_.hasTexCoord) {
            mesh_.texCoords.emplace_back(texCoord[0], 1.0f - texCoord[1]); // v points up
        }
    }

    void addCorner(std::uint32_t vertex) { mesh_.cornerPosition.push_back(vertex); }

    void endFaceWithColor(bool hasColor) {
        mesh_.cornerColor.resize(mesh_.cornerPosition.size(),
                                 hasColor ? static_cast<std::uint32_t>(faceColors.size() - 1) : kNoIndex);
        endFace(file_, mesh_);
    }

    // `areFractions`: the file says so, or no whole number is larger than 1.
    MeshFile finish(bool areFractions) {
        if (mesh_.faceEnd.empty()) {
            file_.refuse("OFF: there are " + std::to_string(mesh_.positions.size()) +
                         " vertices, but no faces; points are not rendered");
        }
        MeshFile result;
        // Colours of vertices are finer than those of faces.
        FileColors& colors = vertexColors.empty() ? faceColors : vertexColors;
        if (colors.empty()) {
            mesh_.cornerColor.clear();
        } else {
            if (&colors == &vertexColors) {
                mesh_.cornerColor.clear();
            }
            colors.setFractions(areFractions || colors.largest() <= 1.0f);
            mesh_.colors = colors.decoded();
        }
        result.polygons = std::move(mesh_);
        return result;
    }

    FileColors vertexColors; // one for each vertex, or none
    FileColors faceColors;   // of the faces that have one

  private:
    const InputFile& file_;
    VertexForm form_;
    PolygonMesh mesh_;
};

class OffTextReader {
  public:
    OffTextReader(InputFile& file, std::string_view text, const VertexForm& form, bool isFreeForm)
        : file_(file), size_(text.size()), scanner_(text, TextScanner::Comments::cut), form_(form),
          isFreeForm_(isFreeForm), mesh_(file, form) {}

    // The text begins behind the word OFF.
    MeshFile read() {
        scanner_.nextLine();
        checkDimension();
        const Counts counts = readCounts();
        checkCounts(file_, counts, 6, 2, size_); // a digit and a blank for each number
        for (index_ = 0; index_ < counts.vertices; ++index_) {
            readVertex();
        }
        finishVertexColors(counts.vertices);
        element_ = "face";
        for (index_ = 0; index_ < counts.faces; ++index_) {
            readFace(counts.vertices);
        }
        finishWarnings();
        return mesh_.finish(areFractions_);
    }

  private:
    void checkDimension() {
        if (form_.hasDimension) {
            element_ = "header";
            if (const std::uint64_t dimension = readCount(nextWord()); dimension != 3) {
                file_.refuse("OFF: vertices have " + std::to_string(dimension) + " dimensions instead of 3");
            }
        }
    }

    // The number of edges is not used. It may be missing, unless each count has a line of its own.
    Counts readCounts() {
        element_ = "header";
        Counts counts;
        counts.vertices = readCount(nextWord());
        const std::uint64_t line = scanner_.lineNumber();
        counts.faces = readCount(nextWord());
        if (scanner_.nextWord().empty() && scanner_.lineNumber() != line) {
            nextWord();
        }
        element_ = "vertex";
        return counts;
    }

    void readVertex() {
        beginElement();
        float position[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        float normal[3] = {};
        float texCoord[2] = {};
        for (int axis = 0; axis < (form_.isHomogeneous ? 4 : 3); ++axis) {
            position[axis] = readNumber();
        }
        for (int axis = 0; axis < (form_.hasNormal ? 3 : 0); ++axis) {
            normal[axis] = readNumber();
        }
        if (isFreeForm_) {
            if (form_.hasColor) {
                words_ = {nextWord(), nextWord(), nextWord(), nextWord()};
                addColor(mesh_.vertexColors, words_);
            }
            for (int axis = 0; axis < (form_.hasTexCoord ? 2 : 0); ++axis) {
                texCoord[axis] = readNumber();
            }
        } else {
            readRestOfVertex(texCoord);
        }
        mesh_.addVertex(position, normal, texCoord);
    }

    // A colour has three or four numbers. Some programs write colours without saying so in the first line.
    void readRestOfVertex(float* texCoord) {
        collectWords();
        std::span<const std::string_view> words = words_;
        if (form_.hasTexCoord) {
            if (words.size() < 2) {
                refuse("the line ends here");
            }
            texCoord[0] = numberOf(words[words.size() - 2]);
            texCoord[1] = numberOf(words[words.size() - 1]);
            words = words.first(words.size() - 2);
        }
        if (words.size() == 3 || words.size() == 4) {
            addColor(mesh_.vertexColors, words);
            for (const std::string_view word : words) {
                const float number = numberOf(word);
                areFractionsOfOne_ = areFractionsOfOne_ && number >= 0.0f && number <= kLargestFraction;
                areBytes_ = areBytes_ && number >= 0.0f && number <= 255.0f && number == std::floor(number);
            }
        } else if (form_.hasColor) {
            refuse("a colour has " + std::to_string(words.size()) + " numbers instead of 3 or 4");
        } else if (!words.empty()) {
            ++longLines_;
        }
    }

    void readFace(std::uint64_t vertexCount) {
        beginElement();
        const std::uint64_t corners = readCount(nextWord());
        for (std::uint64_t corner = 0; corner < corners; ++corner) {
            const std::string_view word = nextWord();
            const std::optional<double> index = parseNumber(word);
            if (!index || !(*index >= 0.0) || *index >= static_cast<double>(vertexCount) ||
                *index != std::floor(*index)) {
                refuse("index " + inQuotes(word) + " is out of range, there are " +
                       std::to_string(vertexCount) + " vertices");
            }
            mesh_.addCorner(static_cast<std::uint32_t>(*index));
        }
        bool hasColor = false;
        if (!isFreeForm_) {
            collectWords();
            // One number would be the index of a colour in a list that is not in the file.
            hasColor = words_.size() == 3 || words_.size() == 4;
            if (hasColor) {
                addColor(mesh_.faceColors, words_);
            }
        }
        mesh_.endFaceWithColor(hasColor);
    }

    void addColor(FileColors& to, std::span<const std::string_view> words) {
        glm::vec3 color(0.0f);
        for (int channel = 0; channel < 3; ++channel) {
            const std::string_view word = words[static_cast<std::size_t>(channel)];
            color[channel] = numberOf(word);
            areFractions_ = areFractions_ || word.find('.') != std::string_view::npos;
        }
        to.add(color, words.size() == 4 ? std::optional(numberOf(words[3])) : std::nullopt);
    }

    void finishVertexColors(std::uint64_t vertices) {
        // Normals without an N are no colours.
        if (!isFreeForm_ && !form_.hasColor && !areFractionsOfOne_ && !areBytes_) {
            longLines_ += mesh_.vertexColors.size();
            mesh_.vertexColors = FileColors();
            areFractions_ = false;
        }
        if (!mesh_.vertexColors.empty() && mesh_.vertexColors.size() != vertices) {
            file_.warn("OFF: only " + std::to_string(mesh_.vertexColors.size()) + " of " +
                       std::to_string(vertices) + " vertices have colours; these are not used");
            mesh_.vertexColors = FileColors();
        }
    }

    void finishWarnings() {
        if (isFreeForm_) {
            if (!scanner_.nextWordOverLines().empty()) {
                refuse("more words follow");
            }
            file_.warn(
                "OFF: vertices and faces are not each on a line of their own; colours of faces are not read");
            return;
        }
        if (longLines_ > 0) {
            file_.warn("OFF: " + std::to_string(longLines_) +
                       " vertices have more numbers than the first line says; these are not read");
        }
        if (const std::string_view word = scanner_.wordOfLaterLine(); !word.empty()) {
            warnOfBytesAfterFaces(file_, scanner_.bytesFrom(word));
        }
    }

    // An element begins on a new line.
    void beginElement() {
        if (!isFreeForm_) {
            pending_ = readToNextLine();
        }
    }

    std::string_view nextWord() {
        std::string_view word = pending_.empty() ? scanner_.nextWord() : pending_;
        pending_ = {};
        if (word.empty()) {
            if (!isFreeForm_ && element_ != "header") {
                refuse("the line ends here");
            }
            word = readToNextLine();
        }
        return word;
    }

    // Returns the first word of the next line that has any before its '#'.
    std::string_view readToNextLine() {
        const std::string_view word = scanner_.wordOfLaterLine();
        if (word.empty()) {
            refuse("the file ends here");
        }
        return word;
    }

    void collectWords() {
        words_.clear();
        for (std::string_view word = scanner_.nextWord(); !word.empty(); word = scanner_.nextWord()) {
            words_.push_back(word);
        }
    }

    float readNumber() { return numberOf(nextWord()); }

    float numberOf(std::string_view word) const {
        const std::optional<double> number = parseNumber(word);
        if (!number) {
            refuse(inQuotes(word) + " is not a number");
        }
        return static_cast<float>(*number);
    }

    std::uint64_t readCount(std::string_view word) const {
        const std::optional<std::int64_t> count = parseInteger(word);
        if (!count || *count < 0) {
            refuse(inQuotes(word) + " is not a count");
        }
        return static_cast<std::uint64_t>(*count);
    }

    [[noreturn]] void refuse(const std::string& what) const {
        const std::string where =
            element_ == "header" ? "header" : std::string(element_) + ' ' + std::to_string(index_);
        file_.refuse("OFF " + where + ": " + what);
    }

    InputFile& file_;
    std::size_t size_;
    TextScanner scanner_;
    VertexForm form_;
    bool isFreeForm_;
    OffMesh mesh_;
    std::string_view element_ = "header";
    std::uint64_t index_ = 0;
    std::string_view pending_;            // the first word of the element, which beginElement has read
    std::vector<std::string_view> words_; // what is left of a line
    bool areFractions_ = false;
    // What all numbers behind those that the first line announces can be.
    bool areFractionsOfOne_ = true;
    bool areBytes_ = true;
    std::uint64_t longLines_ = 0;
};

// All numbers have 32 bits, the highest byte first.
class OffBinaryReader {
  public:
    OffBinaryReader(InputFile& file, std::string_view bytes, const VertexForm& form)
        : file_(file), rest_(bytes), form_(form), mesh_(file, form) {}

    MeshFile read() {
        if (form_.hasDimension) {
            file_.refuse("OFF: binary files with vertices of n dimensions are not read");
        }
        const std::uint64_t size = rest_.size();
        Counts counts;
        counts.vertices = bits();
        counts.faces = bits();
        bits(); // the number of edges
        checkCounts(file_, counts, 12, 8, size);
        for (std::uint64_t i = 0; i < counts.vertices; ++i) {
            readVertex();
        }
        for (std::uint64_t i = 0; i < counts.faces; ++i) {
            readFace(i, counts.vertices);
        }
        if (!rest_.empty()) {
            warnOfBytesAfterFaces(file_, rest_.size());
        }
        return mesh_.finish(true);
    }

  private:
    void readVertex() {
        float position[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        float normal[3] = {};
        float color[4] = {};
        float texCoord[2] = {};
        readNumbers(position, form_.isHomogeneous ? 4 : 3);
        readNumbers(normal, form_.hasNormal ? 3 : 0);
        readNumbers(color, form_.hasColor ? 4 : 0);
        readNumbers(texCoord, form_.hasTexCoord ? 2 : 0);
        mesh_.addVertex(position, normal, texCoord);
        if (form_.hasColor) {
            mesh_.vertexColors.add({color[0], color[1], color[2]}, color[3]);
        }
    }

    void readFace(std::uint64_t face, std::uint64_t vertexCount) {
        for (std::uint32_t corners = bits(); corners > 0; --corners) {
            const std::uint32_t index = bits();
            if (index >= vertexCount) {
                file_.refuse("OFF face " + std::to_string(face) + ": index " + std::to_string(index) +
                             " is out of range, there are " + std::to_string(vertexCount) + " vertices");
            }
            mesh_.addCorner(index);
        }
        float color[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        const std::uint32_t colors = bits();
        for (std::uint32_t i = 0; i < colors; ++i) {
            const float number = std::bit_cast<float>(bits());
            if (i < 4) {
                color[i] = number;
            }
        }
        const bool hasColor = colors == 3 || colors == 4;
        if (hasColor) {
            mesh_.faceColors.add({color[0], color[1], color[2]}, color[3]);
        }
        mesh_.endFaceWithColor(hasColor);
    }

    void readNumbers(float* to, int count) {
        for (int i = 0; i < count; ++i) {
            to[i] = std::bit_cast<float>(bits());
        }
    }

    std::uint32_t bits() {
        if (rest_.size() < 4) {
            file_.refuse("OFF: the file ends before its last element");
        }
        const auto value = storedNumber<std::uint32_t, std::endian::big>(rest_.data());
        rest_.remove_prefix(4);
        return value;
    }

    InputFile& file_;
    std::string_view rest_;
    VertexForm form_;
    OffMesh mesh_;
};

// The counts stand on the lines behind OFF, but in many files on the same line, and in some (ModelNet40) even
// without a blank.
std::size_t endOfKeyword(std::string_view word) {
    std::size_t end = word.size();
    while (end > 0 && isDigit(word[end - 1])) {
        --end;
    }
    return end;
}

} // namespace

MeshFile readOff(InputFile& file, std::string_view bytes) {
    TextScanner scanner(bytes, TextScanner::Comments::cut);
    const std::string_view keyword = scanner.wordOfLaterLine();
    const std::string_view word = keyword.substr(0, endOfKeyword(keyword));
    // Geomview reads a file that begins with its counts too.
    const bool isMissing = !keyword.empty() && word.empty();
    const bool isOff = word.ends_with("OFF") || word.ends_with("off");
    const std::optional<VertexForm> form =
        isOff ? formNamed(word.substr(0, word.size() - 3)) : std::optional(VertexForm());
    if (!form || (!isOff && !isMissing)) {
        file.refuse("not OFF: does not start with 'OFF'");
    }
    if (scanner.nextWord() == "BINARY") {
        return OffBinaryReader(file, scanner.rest(), *form).read();
    }
    const std::string_view text =
        bytes.substr(static_cast<std::size_t>(word.data() + word.size() - bytes.data()));
    // Read by words, the last word has to be the last number.
    return readLinesElseWords(
        [&](const bool isFreeForm) { return OffTextReader(file, text, *form, isFreeForm).read(); });
}

} // namespace metamarch
