// SPDX-License-Identifier: MIT
// What the readers of OBJ, PLY, OFF and STL deliver: polygons as the file has them.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// The index of an attribute that a corner does not have.
inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

// All indices are in range: a reader refuses a file whose indices are not. Numbers may be infinite or NaN
// where the file says so.
//
// An attribute (normal, texture coordinate, colour) has an array of values and an array with one index for
// each corner. If the values are there and the array of indices is empty, value i belongs to position i.
struct PolygonMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texCoords; // as glTF has them: v points down
    std::vector<glm::vec4> colors;    // linear

    // The corners of all faces, one face after another.
    std::vector<std::uint32_t> cornerPosition;
    std::vector<std::uint32_t> cornerNormal;
    std::vector<std::uint32_t> cornerTexCoord;
    std::vector<std::uint32_t> cornerColor;

    // Face i has the corners from faceEnd[i - 1] (0 for the first) up to, not including, faceEnd[i].
    std::vector<std::uint32_t> faceEnd;
    std::vector<std::uint32_t>
        faceMaterial;                    // empty: no face has one; otherwise one for each face, or kNoIndex
    std::vector<std::uint32_t> facePart; // index into partNames; empty: all faces belong to part 0

    std::vector<std::string> partNames; // objects and groups of an OBJ; at least one
};

} // namespace metamarch
