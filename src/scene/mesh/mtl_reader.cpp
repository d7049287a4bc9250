// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mtl_reader.h"

#include "metamarch/scene/mesh/name_list.h"
#include "metamarch/scene/mesh/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace metamarch {
namespace {

template <class T>
struct Keyword {
    std::string_view word; // in lower case
    T MtlMaterial::*member;
};

constexpr auto kColors = std::to_array<Keyword<std::optional<glm::vec3>>>({
    {"kd", &MtlMaterial::diffuse},
    {"ks", &MtlMaterial::specular},
    {"ke", &MtlMaterial::emission},
});

constexpr auto kNumbers = std::to_array<Keyword<std::optional<float>>>({
    {"ns", &MtlMaterial::exponent},
    {"ni", &MtlMaterial::ior},
    {"tr", &MtlMaterial::transparency},
    {"pr", &MtlMaterial::roughness},
    {"pm", &MtlMaterial::metallic},
    {"ps", &MtlMaterial::sheen},
    {"pc", &MtlMaterial::clearcoat},
    {"pcr", &MtlMaterial::clearcoatRoughness},
    {"aniso", &MtlMaterial::anisotropy},
    {"anisor", &MtlMaterial::anisotropyRotation},
});

constexpr auto kMaps = std::to_array<Keyword<MtlMap>>({
    {"map_kd", &MtlMaterial::diffuseMap},
    {"map_ks", &MtlMaterial::specularMap},
    {"map_ke", &MtlMaterial::emissionMap},
    {"map_emissive", &MtlMaterial::emissionMap},
    {"map_d", &MtlMaterial::opacityMap},
    {"map_opacity", &MtlMaterial::opacityMap},
    {"map_pr", &MtlMaterial::roughnessMap},
    {"map_pm", &MtlMaterial::metallicMap},
    {"map_ps", &MtlMaterial::sheenMap},
    {"map_pc", &MtlMaterial::clearcoatMap},
    {"map_pcr", &MtlMaterial::clearcoatRoughnessMap},
    {"norm", &MtlMaterial::normalMap},
    {"map_norm", &MtlMaterial::normalMap},
    {"bump", &MtlMaterial::bumpMap},
    {"map_bump", &MtlMaterial::bumpMap},
});

// What a path tracer has no use for: ambient light, which it computes, and settings of other renderers.
constexpr auto kIgnoredStatements = std::to_array<std::string_view>({"ka", "map_ka", "sharpness", "map_aat"});

constexpr auto kNotRendered =
    std::to_array<std::string_view>({"tf", "disp", "map_disp", "decal", "map_decal", "refl", "map_refl",
                                     "map_ns", "map_ni", "map_tf", "map_tr", "map_aniso", "map_anisor"});

template <class Table>
auto find(const Table& table, std::string_view word) {
    const auto found = std::ranges::find(table, word, [](const auto& keyword) { return keyword.word; });
    return found == table.end() ? nullptr : &*found;
}

// Returns the first word and removes it.
std::string_view takeWord(std::string_view& line) {
    TextScanner words(line);
    words.nextLine();
    const std::string_view word = words.nextWord();
    line = words.restOfLine();
    return word;
}

// Returns nothing for a number that is not finite.
std::optional<float> finiteNumber(std::string_view word) {
    const std::optional<double> number = parseNumber(word);
    const auto value = static_cast<float>(number.value_or(NAN));
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Removes and returns the number that the line begins with. The last word of a map's line is its file's name,
// even where it looks like a number.
std::optional<float> takeNumber(std::string_view& line) {
    constexpr float kLargest = 1e18f; // so that products stay finite
    std::string_view rest = line;
    const std::optional<float> number = finiteNumber(takeWord(rest));
    if (number && std::abs(*number) <= kLargest && !rest.empty()) {
        line = rest;
        return number;
    }
    return std::nullopt;
}

// A comment follows a name as " # words"; "Material #25" is a name.
std::string_view withoutComment(std::string_view name) {
    for (std::size_t mark = name.find(" #"); mark != std::string_view::npos;
         mark = name.find(" #", mark + 1)) {
        if (mark + 2 == name.size() || name[mark + 2] == ' ' || name[mark + 2] == '\t') {
            return name.substr(0, name.find_last_not_of(" \t", mark) + 1);
        }
    }
    return name;
}

class LibraryReader {
  public:
    LibraryReader(InputFile& file, const std::string& name, std::string_view text)
        : file_(file), name_(name), folder_(std::filesystem::path(name).parent_path().generic_string()),
          scanner_(withJoinedLines(text, joined_)) {}

    // Calls material(name) for each newmtl; it returns the material that the lines after it describe, or null
    // to skip these.
    template <class Named>
    void read(const Named& material) {
        MtlMaterial* current = nullptr;
        while (scanner_.nextLine()) {
            const std::string_view keyword = scanner_.nextWord();
            const std::string_view rest = scanner_.restOfLine();
            if (keyword.starts_with('#')) {
                isByMeshLab_ = isByMeshLab_ || lowerCase(rest).find("meshlab") != std::string::npos;
            } else if (lowerCase(keyword) == "newmtl") {
                current = material(rest);
                if (current != nullptr) {
                    current->isByMeshLab = isByMeshLab_;
                }
            } else if (current != nullptr && !keyword.empty()) {
                readLine(*current, keyword, rest);
            }
        }
        warn(unknown_, "are not known and are skipped");
        warn(notRendered_, "are not rendered");
        warn(noNumber_, "have no number there and are skipped");
        warn(options_, "are options of maps that are not rendered");
    }

  private:
    void readLine(MtlMaterial& material, std::string_view keyword, std::string_view rest) {
        const std::string word = lowerCase(keyword);
        if (const auto* color = find(kColors, word)) {
            readColor(keyword, beforeComment(rest), material.*color->member);
        } else if (const auto* number = find(kNumbers, word)) {
            readNumber(keyword, beforeComment(rest), material.*number->member);
        } else if (word == "d") {
            readOpacity(keyword, beforeComment(rest), material);
        } else if (word == "illum") {
            std::optional<float> model;
            readNumber(keyword, beforeComment(rest), model);
            material.illumination = static_cast<int>(std::clamp(model.value_or(0.0f), 0.0f, 10.0f));
        } else if (const auto* map = find(kMaps, word)) {
            readMap(keyword, rest, material.*map->member);
        } else if (std::ranges::find(kNotRendered, word) != kNotRendered.end()) {
            readNotRendered(keyword, beforeComment(rest));
        } else if (std::ranges::find(kIgnoredStatements, word) == kIgnoredStatements.end()) {
            unknown_.add(keyword);
        }
    }

    void readNumber(std::string_view keyword, std::string_view rest, std::optional<float>& number) {
        if (const std::optional<float> value = finiteNumber(takeWord(rest))) {
            number = value;
        } else {
            noNumber_.add(keyword);
        }
    }

    // A colour of one number is grey. CIEXYZ and spectral curves are not read.
    void readColor(std::string_view keyword, std::string_view rest, std::optional<glm::vec3>& color) {
        const std::string_view first = takeWord(rest);
        if (first == "spectral" || first == "xyz") {
            notRendered_.add(std::string(keyword) + ' ' + std::string(first));
            return;
        }
        const std::string_view second = takeWord(rest);
        const std::string_view third = takeWord(rest);
        const std::optional<float> r = finiteNumber(first);
        const std::optional<float> g = second.empty() ? r : finiteNumber(second);
        const std::optional<float> b = third.empty() ? g : finiteNumber(third);
        if (!r || !g || !b) {
            noNumber_.add(keyword);
            return;
        }
        color = glm::vec3(*r, *g, *b);
    }

    // A halo is less opaque where the surface faces the viewer.
    void readOpacity(std::string_view keyword, std::string_view rest, MtlMaterial& material) {
        std::string_view after = rest;
        if (takeWord(after) == "-halo") {
            notRendered_.add("d -halo");
            rest = after;
        }
        readNumber(keyword, rest, material.opacity);
    }

    // Most files filter no light.
    void readNotRendered(std::string_view keyword, std::string_view rest) {
        if (rest.empty()) {
            return;
        }
        if (lowerCase(keyword) == "tf") {
            std::optional<glm::vec3> filter;
            readColor(keyword, rest, filter);
            if (!filter || *filter == glm::vec3(1.0f) || *filter == glm::vec3(0.0f)) {
                return;
            }
        }
        notRendered_.add(keyword);
    }

    void readMap(std::string_view keyword, std::string_view rest, MtlMap& map) {
        MtlMap read;
        while (rest.starts_with('-') && readOption(keyword, rest, read)) {
        }
        if (rest.empty()) {
            return; // some programs write the keyword of every map
        }
        read.name = rest;
        read.folder = folder_;
        map = read;
    }

    // Returns false, and leaves the line as it is, if it does not begin with an option: then the file's name
    // does.
    bool readOption(std::string_view keyword, std::string_view& rest, MtlMap& map) {
        std::string_view after = rest;
        const std::string option = lowerCase(takeWord(after));
        if (option == "-s" || option == "-o" || option == "-t") {
            readVector(option, after, map);
        } else if (option == "-mm") {
            const std::optional<float> base = takeNumber(after);
            map.valueFactor = takeNumber(after).value_or(1.0f);
            if (base.value_or(0.0f) != 0.0f) {
                options_.add("-mm with a base");
            }
        } else if (option == "-bm") {
            map.bumpMultiplier = takeNumber(after).value_or(1.0f);
        } else if (option == "-boost" || option == "-texres") {
            takeNumber(after);
            options_.add(option);
        } else if (option == "-clamp" || option == "-blendu" || option == "-blendv" || option == "-cc") {
            readSwitch(option, lowerCase(takeWord(after)), map);
        } else if (option == "-imfchan") {
            readChannel(keyword, lowerCase(takeWord(after)), map);
        } else if (option == "-type" || option == "-colorspace") {
            takeWord(after);
            options_.add(option);
        } else {
            return false;
        }
        rest = after;
        return true;
    }

    // Reads one to three numbers.
    void readVector(const std::string& option, std::string_view& rest, MtlMap& map) {
        glm::vec2 value(option == "-s" ? 1.0f : 0.0f);
        for (int i = 0; i < 3; ++i) {
            const std::optional<float> number = takeNumber(rest);
            if (!number) {
                break;
            }
            if (i < 2) {
                value[i] = *number;
            }
        }
        if (option == "-s") {
            map.scale = value;
        } else if (option == "-o") {
            map.offset = value;
        } else {
            options_.add(option);
        }
    }

    void readSwitch(const std::string& option, const std::string& value, MtlMap& map) {
        if (option == "-clamp") {
            map.clamp = value == "on";
        } else if (value == (option == "-cc" ? "on" : "off")) { // what it is not by itself
            options_.add(option + ' ' + value);
        }
    }

    // A colour has no use for one channel.
    void readChannel(std::string_view keyword, const std::string& value, MtlMap& map) {
        const std::string word = lowerCase(keyword);
        const bool isColor = word == "map_kd" || word == "map_ks" || word == "map_ke" || word == "norm";
        const bool isKnown = value == "r" || value == "g" || value == "b" || value == "m" || value == "l";
        if (isKnown && !isColor) {
            map.channel = value[0];
        } else {
            options_.add("-imfchan " + value + " of " + std::string(keyword));
        }
    }

    void warn(const NameList& names, const char* what) {
        if (!names.empty()) {
            file_.warn('\'' + name_ + "': " + names.text() + ' ' + what);
        }
    }

    InputFile& file_;
    const std::string& name_;
    std::string folder_; // of the library, relative to the OBJ's
    std::string joined_;
    TextScanner scanner_;
    bool isByMeshLab_ = false;
    NameList unknown_;
    NameList notRendered_;
    NameList noNumber_;
    NameList options_;
};

} // namespace

void MtlMaterials::want(std::string_view name) { wanted_.emplace(withoutComment(name)); }

void MtlMaterials::read(InputFile& file, const std::string& name, std::string_view text) {
    LibraryReader(file, name, text).read([this](std::string_view material) { return wanted(material); });
}

MtlMaterial* MtlMaterials::wanted(std::string_view name) {
    const std::string key(withoutComment(name));
    if (!wanted_.contains(key)) {
        return nullptr;
    }
    const auto [found, isNew] = indices_.try_emplace(key, static_cast<std::uint32_t>(materials_.size()));
    if (isNew) {
        materials_.emplace_back().name = key;
    }
    return &materials_[found->second];
}

std::optional<std::uint32_t> MtlMaterials::find(std::string_view name) const {
    const auto found = indices_.find(std::string(withoutComment(name)));
    return found == indices_.end() ? std::nullopt : std::optional(found->second);
}

} // namespace metamarch
