// SPDX-License-Identifier: MIT
// A scene as all later stages see it: world-space triangles, materials, textures, lights and cameras. Nothing
// in it depends on a file format.
#pragma once
#include "metamarch/geometry/triangle_mesh.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace metamarch {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

// One mesh of the file at one place in the node hierarchy; a glTF mesh that two nodes use makes two.
struct MeshInstance {
    std::string name;       // of the mesh
    std::uint32_t mesh = 0; // its index in the file
    std::string node{};     // name of the node that places it; empty in files without nodes
    std::string root{};     // name of the topmost node above that one, or of that one
};

// The camera looks along `forward`. Right, up and -forward are orthonormal and in world space.
struct SceneCamera {
    enum class Projection { perspective, orthographic };

    std::string name;
    Projection projection = Projection::perspective;
    glm::vec3 eye{0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float verticalFov = 0.8f;    // radians; perspective only
    float verticalExtent = 2.0f; // height of the picture, world units; orthographic only
};

// A light without extent (KHR_lights_punctual), in world space and glTF's units. The light's range is
// dropped: it only limits what a rasterizer has to draw, and real light has no such limit.
struct PunctualLight {
    enum class Type { directional, point, spot };

    std::string name;
    Type type = Type::point;
    glm::vec3 color{1.0f};    // linear, in [0, 1]
    float intensity = 1.0f;   // candela, for directional lights lux; at least 0
    glm::vec3 position{0.0f}; // point and spot only
    // Direction in which light travels, unit length; directional and spot only.
    glm::vec3 direction{0.0f, 0.0f, -1.0f};
    // Radians from `direction`, 0 <= inner <= outer <= pi / 2. Full intensity inside the inner cone, none
    // outside the outer.
    float innerConeAngle = 0.0f;
    float outerConeAngle = 0.785398163f; // pi / 4
};

struct SceneAnimation {
    std::string name;     // may be empty
    double seconds = 0.0; // when its last key is
};

// All per-vertex arrays have the same length, except that an optional one is empty if no primitive has it.
// All per-triangle arrays have the same length. Every index is in range and every number is finite: importers
// refuse or repair everything else.
struct Scene {
    std::vector<glm::vec3> positions; // world space
    // Unit length; zero where the file gives none, which means the triangle's normal.
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texCoords;  // zero where the file gives none
    std::vector<glm::vec2> texCoords1; // optional; otherwise like texCoords
    std::vector<glm::vec2> texCoords2; // likewise
    std::vector<glm::vec2> texCoords3; // likewise
    // Optional; linear; multiplies the base colour; 1 where the file gives none.
    std::vector<glm::vec4> colors;
    // Optional. xyz: unit length, world space, perpendicular to the normal only if the file says so. The
    // bitangent, which points up in a normal map, is w * cross(normal, xyz) with w = 1 or -1. Zero where
    // there is none.
    std::vector<glm::vec4> tangents;

    std::vector<glm::uvec3> triangles;           // vertex indices, counter-clockwise seen from the front
    std::vector<std::uint32_t> triangleMesh;     // index into meshes
    std::vector<std::uint32_t> triangleMaterial; // index into materials, or kNoMaterial

    std::vector<MeshInstance> meshes;
    std::vector<Material> materials; // a material that no triangle uses has no textures
    std::vector<Texture> textures;   // only textures in use
    std::vector<TextureImage> images;
    std::vector<PunctualLight> lights;
    std::vector<SceneCamera> cameras;
    std::vector<std::string> scenes;        // valid names for ImportOptions::scene, in file order
    std::vector<std::string> variants;      // valid names for ImportOptions::variant, in file order
    std::vector<SceneAnimation> animations; // of the file, whichever poses the scene

    std::vector<std::filesystem::path>
        files;                         // its own, and those that it names: buffers, textures, materials
    std::vector<std::string> warnings; // one line each, for the user

    // When the last animation ends; 0 if nothing moves.
    double animationSeconds() const {
        double last = 0.0;
        for (const SceneAnimation& animation : animations) {
            last = std::max(last, animation.seconds);
        }
        return last;
    }

    // The triangles, as acceleration structures take them.
    operator TriangleMesh() const { return {positions, triangles}; }
};

} // namespace metamarch
