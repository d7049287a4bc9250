// A scene as every later part sees it: world-space triangles, materials, cameras. No file format is left in
// it.
#pragma once
#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

struct Material {
    std::string name;
    glm::vec4 baseColor{1.0f}; // linear
    glm::vec3 emission{0.0f};  // linear radiance
    float metallic = 0.0f;
    float roughness = 1.0f;
    bool doubleSided = false;
};

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

// Per-vertex arrays are of one length; per-triangle arrays are of one length. Every index is in range, every
// position finite: importers refuse anything else.
struct Scene {
    std::vector<glm::vec3> positions; // world space
    std::vector<glm::vec3> normals;   // unit length; zero where the file gives none
    std::vector<glm::vec2> texCoords; // zero where the file gives none

    std::vector<glm::uvec3> triangles;           // vertex indices, counter-clockwise seen from the front
    std::vector<std::uint32_t> triangleMesh;     // into meshes
    std::vector<std::uint32_t> triangleMaterial; // into materials, or kNoMaterial

    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<SceneCamera> cameras;

    std::vector<std::string> warnings; // one line each, for the user
};

// Box around every position that a triangle uses; `lo > hi` in every axis when there is no triangle.
struct Bounds {
    glm::vec3 lo;
    glm::vec3 hi;
};

Bounds boundsOf(const Scene& scene);

} // namespace metamarch
