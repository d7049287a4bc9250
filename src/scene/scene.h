// A scene as every later part sees it: world-space triangles, materials, textures, lights, cameras. No file
// format is left in it.
#pragma once
#include "metamarch/geometry/triangle_mesh.h"
#include "metamarch/scene/material.h"
#include "metamarch/scene/texture.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

// One mesh of the file at one place of the node hierarchy (glTF: a mesh instanced twice makes two).
struct MeshInstance {
    std::string name;
};

// Looks along `forward`; the three axes are orthonormal and in world space.
struct SceneCamera {
    enum class Projection { perspective, orthographic };

    std::string name;
    Projection projection = Projection::perspective;
    glm::vec3 eye{0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float verticalFov = 0.8f;    // radians, perspective only
    float verticalExtent = 2.0f; // height of the picture in world units, orthographic only
};

// A light without extent (KHR_lights_punctual), in world space and glTF's units. A light's range is not kept:
// it limits what a rasterizer has to draw, light itself knows no such end.
struct PunctualLight {
    enum class Type { directional, point, spot };

    std::string name;
    Type type = Type::point;
    glm::vec3 color{1.0f};                  // linear, in [0, 1]
    float intensity = 1.0f;                 // candela, of directional lux; at least 0
    glm::vec3 position{0.0f};               // of point and spot
    glm::vec3 direction{0.0f, 0.0f, -1.0f}; // where the light goes, unit length; of directional and spot
    // Radians from `direction`, 0 <= inner <= outer <= pi / 2: full intensity inside, none outside.
    float innerConeAngle = 0.0f;
    float outerConeAngle = 0.785398163f; // pi / 4
};

// Per-vertex arrays are of one length, but that the optional ones are empty where no primitive has them;
// per-triangle arrays are of one length. Every index is in range, every number finite: importers refuse or
// mend anything else.
struct Scene {
    std::vector<glm::vec3> positions; // world space
    std::vector<glm::vec3> normals; // unit length; zero where the file gives none: the triangle's own counts
    std::vector<glm::vec2> texCoords;  // zero where the file gives none
    std::vector<glm::vec2> texCoords1; // optional, as texCoords
    std::vector<glm::vec4> colors; // optional, linear, multiplies the base colour; one where there is none
    // Optional. xyz: unit length, world space, at a right angle to the normal only if the file says so; the
    // bitangent, up in a normal map, is w * cross(normal, xyz), w = 1 or -1. Zero where there is none.
    std::vector<glm::vec4> tangents;

    std::vector<glm::uvec3> triangles;           // vertex indices, counter-clockwise seen from the front
    std::vector<std::uint32_t> triangleMesh;     // into meshes
    std::vector<std::uint32_t> triangleMaterial; // into materials, or kNoMaterial

    std::vector<MeshInstance> meshes;
    std::vector<Material> materials; // those that no triangle uses have no textures
    std::vector<Texture> textures;   // those in use
    std::vector<TextureImage> images;
    std::vector<PunctualLight> lights;
    std::vector<SceneCamera> cameras;
    std::vector<std::string> variants; // names that ImportOptions::variant may give, in file order
    double animationSeconds = 0.0;     // when the last animation ends; 0: nothing moves

    std::vector<std::string> warnings; // one line each, for the user

    // What acceleration structures are built over.
    operator TriangleMesh() const { return {positions, triangles}; }
};

} // namespace metamarch
