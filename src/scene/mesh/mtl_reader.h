// SPDX-License-Identifier: MIT
// Reads material libraries of OBJ: MTL by Wavefront ("MTL material format", version 4.2, 1995) with the PBR
// extension of exocortex ("Extending the Wavefront MTL format for physically-based rendering").
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace metamarch {

// The use of a picture by a material. The options are those that are rendered; the reader warns of others.
struct MtlMap {
    std::string name;   // as the file has it, without blanks around it; empty: no map
    std::string folder; // of the library, relative to the OBJ's
    // -s and -o: the map is looked up at scale * (u, v) + offset, v up (as Blender and three.js do)
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};
    bool clamp = false;          // -clamp
    float bumpMultiplier = 1.0f; // -bm
    float valueFactor = 1.0f;    // the second number of -mm, "gain": multiplies the map's values
    char channel = '\0';         // -imfchan: r g b m (matte, which is alpha) l (luminance); 0: not given

    bool isGiven() const { return !name.empty(); }
};

// A material as the file has it. All numbers are finite.
struct MtlMaterial {
    std::string name;
    std::optional<glm::vec3> diffuse;        // Kd
    std::optional<glm::vec3> specular;       // Ks
    std::optional<glm::vec3> emission;       // Ke
    std::optional<float> exponent;           // Ns
    std::optional<float> ior;                // Ni
    std::optional<float> opacity;            // d
    std::optional<float> transparency;       // Tr
    int illumination = 0;                    // illum
    std::optional<float> roughness;          // Pr
    std::optional<float> metallic;           // Pm
    std::optional<float> sheen;              // Ps
    std::optional<float> clearcoat;          // Pc
    std::optional<float> clearcoatRoughness; // Pcr
    std::optional<float> anisotropy;         // aniso
    std::optional<float> anisotropyRotation; // anisor: turns
    bool isByMeshLab = false;                // for which Tr is the opacity

    MtlMap diffuseMap;            // map_Kd
    MtlMap specularMap;           // map_Ks
    MtlMap emissionMap;           // map_Ke
    MtlMap opacityMap;            // map_d
    MtlMap roughnessMap;          // map_Pr
    MtlMap metallicMap;           // map_Pm
    MtlMap sheenMap;              // map_Ps
    MtlMap clearcoatMap;          // map_Pc
    MtlMap clearcoatRoughnessMap; // map_Pcr
    MtlMap normalMap;             // norm
    MtlMap bumpMap;               // bump, map_bump
};

// The materials that an OBJ uses, of all libraries that it names.
class MtlMaterials {
  public:
    // Announces a material that faces use; a comment may follow `name`. Only such materials are read.
    void want(std::string_view name);

    // Reads a library that lies in the folder of `file` or below it; `name` is relative to that folder. Skips
    // with a warning what is not known, not rendered or no number. A material that is there already takes the
    // numbers and maps of one with the same name.
    void read(InputFile& file, const std::string& name, std::string_view text);

    const std::vector<MtlMaterial>& all() const { return materials_; }

    // Returns an index into all(). A comment may follow `name`.
    std::optional<std::uint32_t> find(std::string_view name) const;

  private:
    MtlMaterial* wanted(std::string_view name); // null if it is not

    std::unordered_set<std::string> wanted_;
    std::vector<MtlMaterial> materials_;
    std::unordered_map<std::string, std::uint32_t> indices_; // by name
};

} // namespace metamarch
