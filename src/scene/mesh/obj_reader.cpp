// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/companion_name.h"
#include "metamarch/scene/mesh/mesh_reader.h"
#include "metamarch/scene/mesh/mtl_material.h"
#include "metamarch/scene/mesh/name_list.h"
#include "metamarch/scene/mesh/text_scanner.h"
#include "metamarch/scene/mesh/vertex_color.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

namespace metamarch {
namespace {

// What the corners of faces refer to.
enum Kind : std::size_t { kPosition, kTexCoord, kNormal };
constexpr std::array<const char*, 3> kKindNames = {"vertex", "texture coordinate", "normal"};

constexpr auto kFreeForm = std::to_array<std::string_view>(
    {"cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
     "scrv",   "sp",  "end",  "con",  "vp",   "bsp",   "bzp",  "cdc",  "cdp",  "res"});

// A path tracer has no use for smoothing groups (normals are given or are the triangles'), merging groups and
// settings of other renderers.
constexpr auto kIgnoredKeywords = std::to_array<std::string_view>(
    {"s", "mg", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech"});

template <class Table>
bool contains(const Table& table, std::string_view word) {
    return std::ranges::find(table, word) != table.end();
}

class ObjReader {
  public:
    ObjReader(InputFile& file, std::string_view text) : file_(file), scanner_(text), textures_(file) {
        colors_.setFractions(true);
        result_.polygons.partNames.emplace_back();
        partIndices_.try_emplace("", 0);
    }

    MeshFile read() {
        while (scanner_.nextLine()) {
            readLine(scanner_.nextWord());
        }
        finishIndices();
        finishColors();
        readMaterials();
        warnOfSkipped();
        return std::move(result_);
    }

  private:
    PolygonMesh& mesh() { return result_.polygons; }

    void readLine(std::string_view keyword) {
        // $ begins a comment in files of Viewpoint.
        if (keyword.empty() || keyword.starts_with('#') || keyword.starts_with('$')) {
            return;
        }
        if (keyword == "v") {
            readVertex();
        } else if (keyword == "vt") {
            const std::array<float, 3> uvw = readNumbers<3>(1);
            mesh().texCoords.emplace_back(uvw[0], 1.0f - uvw[1]); // OBJ's v points up
        } else if (keyword == "vn") {
            const std::array<float, 3> xyz = readNumbers<3>(3);
            mesh().normals.emplace_back(xyz[0], xyz[1], xyz[2]);
        } else if (keyword == "f" || keyword == "fo") { // fo is what version 2 had
            readFace();
        } else if (keyword == "usemtl") {
            material_ = indexOf(materialNames_, materialIndices_, std::string(scanner_.restOfLine()));
        } else if (keyword == "o" || keyword == "g") {
            part_ = indexOf(mesh().partNames, partIndices_, std::string(scanner_.restOfLine()));
        } else if (keyword == "mtllib") {
            addLibraries(scanner_.restOfLine());
        } else if (keyword == "l" || keyword == "p") {
            ++(keyword == "l" ? lines_ : points_);
        } else if (contains(kFreeForm, keyword)) {
            ++freeForms_;
            freeFormNames_.add(keyword);
        } else if (!contains(kIgnoredKeywords, keyword)) {
            unknown_.add(keyword);
        }
    }

    // Reads up to N numbers, of which `least` must be there; `count_` is how many are.
    template <std::size_t N>
    std::array<float, N> readNumbers(std::size_t least) {
        scanner_.cutComment();
        std::array<float, N> numbers{};
        for (count_ = 0; count_ < N; ++count_) {
            const std::string_view word = scanner_.nextWord();
            if (word.empty()) {
                break;
            }
            const std::optional<double> number = parseNumber(word);
            if (!number) {
                refuse(inQuotes(word) + " is not a number");
            }
            numbers[count_] = static_cast<float>(*number);
        }
        if (count_ < least) {
            refuse("there are " + std::to_string(count_) + " numbers in place of " + std::to_string(least));
        }
        return numbers;
    }

    // x y z, x y z w, x y z r g b, or x y z r g b a. The weight w is for free-form curves and surfaces only.
    void readVertex() {
        const std::array<float, 7> numbers = readNumbers<7>(3);
        if (count_ >= 6) {
            // Vertices before the first with a colour are white.
            while (colors_.size() < mesh().positions.size()) {
                colors_.add(glm::vec3(1.0f), std::nullopt);
            }
            colors_.add({numbers[3], numbers[4], numbers[5]},
                        count_ == 7 ? std::optional(numbers[6]) : std::nullopt);
        } else if (!colors_.empty()) {
            colors_.add(glm::vec3(1.0f), std::nullopt);
        }
        mesh().positions.emplace_back(numbers[0], numbers[1], numbers[2]);
    }

    void readFace() {
        scanner_.cutComment();
        for (std::string_view word = scanner_.nextWord(); !word.empty(); word = scanner_.nextWord()) {
            readCorner(word);
        }
        endFace(file_, mesh());
        mesh().faceMaterial.push_back(material_);
        mesh().facePart.push_back(part_);
    }

    // v, v/vt, v//vn or v/vt/vn
    void readCorner(std::string_view word) {
        const std::string_view whole = word;
        const auto part = [&word] {
            const std::string_view before = word.substr(0, word.find('/'));
            word.remove_prefix(std::min(before.size() + 1, word.size()));
            return before;
        };
        const std::string_view position = part();
        const std::string_view texCoord = part();
        const std::string_view normal = part();
        if (position.empty() || !word.empty()) {
            refuse(inQuotes(whole) + " is not a corner of a face");
        }
        mesh().cornerPosition.push_back(readIndex(kPosition, position, mesh().positions.size()));
        mesh().cornerTexCoord.push_back(readIndex(kTexCoord, texCoord, mesh().texCoords.size()));
        mesh().cornerNormal.push_back(readIndex(kNormal, normal, mesh().normals.size()));
    }

    // Indices count from 1; negative ones count back from what has been read so far, `count`. A positive
    // index may name what follows. Whether all are in range is known at the end.
    std::uint32_t readIndex(Kind kind, std::string_view word, std::size_t count) {
        if (word.empty()) {
            return kNoIndex;
        }
        isUsed_[kind] = true;
        const std::optional<std::int64_t> number = parseInteger(word);
        if (!number) {
            refuse(inQuotes(word) + " is not an index");
        }
        if (*number == 0 && kind != kPosition) { // some programs write it for a corner that has none
            ++zeros_[kind];
            return kNoIndex;
        }
        const auto size = static_cast<std::int64_t>(count);
        const std::int64_t index = *number < 0 ? size + *number : *number - 1;
        const bool isNeverInRange = index < 0 || index >= kNoIndex;
        if (isNeverInRange || index >= size) {
            std::optional<Worst>& worst = worst_[kind];
            if (!worst || (!worst->isNeverInRange && (isNeverInRange || index > worst->index))) {
                worst = {index, isNeverInRange, *number, count, scanner_.lineNumber()};
            }
        }
        return isNeverInRange ? kNoIndex : static_cast<std::uint32_t>(index);
    }

    void finishIndices() {
        checkIndices(kPosition, mesh().positions.size());
        finishAttribute(kTexCoord, mesh().texCoords, mesh().cornerTexCoord);
        finishAttribute(kNormal, mesh().normals, mesh().cornerNormal);
    }

    // Some programs write indices of what they do not write, or what no face uses.
    template <class T>
    void finishAttribute(Kind kind, std::vector<T>& values, std::vector<std::uint32_t>& corners) {
        if (isUsed_[kind] && !values.empty()) {
            checkIndices(kind, values.size());
            if (zeros_[kind] > 0) {
                file_.warn(std::to_string(zeros_[kind]) + " corners of faces have the " + kKindNames[kind] +
                           " index 0, which is taken for none: indices count from 1");
            }
            return;
        }
        if (isUsed_[kind]) {
            file_.warn(std::string("faces have indices of ") + kKindNames[kind] +
                       "s, but there are none in the file; they are ignored");
        }
        values.clear();
        corners.clear();
    }

    void checkIndices(Kind kind, std::size_t count) const {
        const std::optional<Worst>& worst = worst_[kind];
        if (worst && (worst->isNeverInRange || worst->index >= static_cast<std::int64_t>(count))) {
            const std::string range =
                worst->number == 0 ? ": indices count from 1"
                : worst->number < 0
                    ? " is out of range, there are " + std::to_string(worst->count) + " before it"
                    : " is out of range, there are " + std::to_string(count);
            refuseAt(worst->line,
                     std::string(kKindNames[kind]) + " index " + std::to_string(worst->number) + range);
        }
    }

    void finishColors() {
        if (!colors_.empty()) {
            mesh().colors = colors_.decoded();
        }
    }

    static std::uint32_t indexOf(std::vector<std::string>& names,
                                 std::unordered_map<std::string, std::uint32_t>& indices, std::string name) {
        const auto [found, isNew] = indices.try_emplace(name, static_cast<std::uint32_t>(names.size()));
        if (isNew) {
            names.push_back(std::move(name));
        }
        return found->second;
    }

    // Several names may stand on a line, and a name may have blanks in it: a name goes on to the next word
    // that ends in .mtl.
    void addLibraries(std::string_view rest) {
        std::size_t length = 0; // of the name so far
        while (!rest.empty() && !(length == 0 && rest.starts_with('#'))) {
            length = std::min(rest.find_first_of(" \t", rest.find_first_not_of(" \t", length)), rest.size());
            if (length == rest.size() || endsName(rest.substr(0, length))) {
                addLibrary(std::string(rest.substr(0, length)));
                rest.remove_prefix(length);
                rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
                length = 0;
            }
        }
    }

    void addLibrary(std::string name) {
        constexpr std::size_t kMostLibraries = 1000; // each is looked for in several places
        if (libraries_.size() == kMostLibraries) {
            file_.warn("there are more than " + std::to_string(libraries_.size()) +
                       " material libraries; the others are not read");
        } else if (libraryNames_.insert(name).second) {
            libraries_.push_back(std::move(name));
        }
    }

    static bool endsName(std::string_view name) {
        if (name.ends_with('"')) {
            name.remove_suffix(1);
        }
        return name.size() > 4 && lowerCaseEnding(name.substr(name.size() - 5)) == ".mtl";
    }

    void readMaterials() {
        MtlMaterials library;
        std::vector<bool> isUsed(materialNames_.size(), false);
        for (const std::uint32_t material : mesh().faceMaterial) {
            if (material != kNoIndex && !isUsed[material]) {
                isUsed[material] = true;
                library.want(materialNames_[material]);
            }
        }
        std::unordered_set<std::string> seen;
        for (const std::string& name : libraries_) {
            readLibrary(library, seen, name);
        }
        for (const MtlMaterial& material : library.all()) {
            result_.materials.push_back(textures_.read(material));
        }
        textures_.warn();
        result_.textures = textures_.textures();
        result_.textureSources = textures_.sources();

        std::vector<std::uint32_t> materialOf; // indexed like materialNames_
        NameList missing;
        for (std::size_t i = 0; i < materialNames_.size(); ++i) {
            const std::string& name = materialNames_[i];
            const std::optional<std::uint32_t> found = library.find(name);
            materialOf.push_back(found.value_or(kNoIndex));
            if (!found && isUsed[i] && !name.empty()) {
                missing.add(name);
            }
        }
        if (!missing.empty()) {
            file_.warn("no material library has the materials " + missing.text());
        }
        for (std::uint32_t& material : mesh().faceMaterial) {
            material = material == kNoIndex ? kNoIndex : materialOf[material];
        }
    }

    // A library that is missing may have been renamed with the OBJ.
    void readLibrary(MtlMaterials& library, std::unordered_set<std::string>& seen, const std::string& given) {
        std::string name = companionName(file_, "", given);
        if (const std::string reason = file_.whyNotReadable(name); !reason.empty()) {
            const std::string own = file_.path().stem().string() + ".mtl";
            const bool isReplaced = reason == "is missing" && file_.whyNotReadable(own).empty();
            file_.warn("material library " + inQuotes(name) + ' ' + reason +
                       (isReplaced ? "; " + inQuotes(own) + " is read in its place" : " and is not read"));
            if (!isReplaced) {
                return;
            }
            name = own;
        }
        std::error_code failure;
        if (!seen.insert(std::filesystem::canonical(file_.companion(name), failure).string()).second) {
            return;
        }
        file_.addCompanion(name);
        const std::optional<std::vector<unsigned char>> bytes = readBytes(file_.companion(name));
        if (!bytes) {
            file_.warn("material library " + inQuotes(name) + " cannot be opened");
            return;
        }
        library.read(file_, name, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    }

    void warnOfSkipped() {
        if (lines_ + points_ + freeForms_ > 0) {
            std::string text;
            const auto add = [&text](std::uint64_t count, const std::string& what) {
                if (count > 0) {
                    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
                }
            };
            add(lines_, "lines");
            add(points_, "point elements");
            add(freeForms_, "free-form statements (" + freeFormNames_.text() + ")");
            file_.warn(text + " are not rendered");
        }
        if (!unknown_.empty()) {
            file_.warn("the keywords " + unknown_.text() + " are not known and are skipped");
        }
    }

    [[noreturn]] void refuse(const std::string& what) const { refuseAt(scanner_.lineNumber(), what); }
    [[noreturn]] void refuseAt(std::uint64_t line, const std::string& what) const {
        file_.refuse("line " + std::to_string(line) + ": " + what);
    }

    // The index that is farthest out of the range that was known when it was read.
    struct Worst {
        std::int64_t index;  // from 0
        bool isNeverInRange; // what follows can't bring it into range
        std::int64_t number; // as the file has it
        std::size_t count;   // of what could be named when it was read
        std::uint64_t line;
    };

    InputFile& file_;
    TextScanner scanner_;
    MtlTextures textures_;
    MeshFile result_;
    std::size_t count_ = 0; // of the numbers that readNumbers found
    FileColors colors_;
    std::array<std::optional<Worst>, 3> worst_;
    std::array<bool, 3> isUsed_{};
    std::array<std::uint64_t, 3> zeros_{}; // indices that are 0

    std::uint32_t part_ = 0;
    std::unordered_map<std::string, std::uint32_t> partIndices_;
    std::uint32_t material_ = kNoIndex; // into materialNames_
    std::vector<std::string> materialNames_;
    std::unordered_map<std::string, std::uint32_t> materialIndices_;
    std::vector<std::string> libraries_; // each once
    std::unordered_set<std::string> libraryNames_;

    std::uint64_t lines_ = 0;
    std::uint64_t points_ = 0;
    std::uint64_t freeForms_ = 0;
    NameList freeFormNames_;
    NameList unknown_;
};

} // namespace

MeshFile readObj(InputFile& file, std::string_view bytes) {
    std::string joined;
    return ObjReader(file, withJoinedLines(bytes, joined)).read();
}

} // namespace metamarch
