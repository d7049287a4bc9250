// Writes one mesh instance into a scene, in world space: the one place where importers' geometry becomes a
// Scene.
#pragma once
#include "scene/scene.h"
#include "scene/scene_file.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace metamarch {

// Vertices and triangles a scene may have: one bit of the 32 stays free for whoever packs an index.
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 31;

class InstanceWriter {
  public:
    // `label` starts the error lines of this mesh. A mirroring `toWorld` turns the triangles round, so that
    // the front stays the front; a singular one is allowed.
    InstanceWriter(Scene& scene, SceneFile& file, const std::string& name, std::string label,
                   const glm::dmat4& toWorld);

    // Later vertices and triangles belong to this part (glTF: primitive); triangle indices count from its
    // first vertex. Throws Error(outOfMemory) when the scene would grow past kMaxVertices or kMaxTriangles.
    void beginPart(std::string label, std::uint64_t vertexCount, std::uint64_t triangleCount,
                   std::uint32_t material);

    // Object space; the normal of any length. Throws Error(sceneRefused) when the world position is not
    // finite. A given normal or texture coordinate that is broken becomes zero, which finish() says once for
    // the mesh.
    void addVertex(const glm::dvec3& position, const std::optional<glm::dvec3>& normal,
                   const std::optional<glm::dvec2>& texCoord);

    // Throws Error(sceneRefused) when an index is not below the part's vertex count.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    void finish();

  private:
    glm::vec3 worldNormal(const glm::dvec3& normal);
    glm::vec2 checkedTexCoord(const glm::dvec2& texCoord);

    Scene& scene_;
    SceneFile& file_;
    std::string label_;
    std::string partLabel_;
    glm::dmat4 toWorld_;
    glm::dmat3 normalToWorld_;
    bool mirrored_;
    std::uint32_t mesh_;
    std::uint32_t material_ = kNoMaterial;
    std::uint32_t firstVertex_ = 0;
    std::uint32_t vertexCount_ = 0;
    std::uint64_t brokenNormals_ = 0;
    std::uint64_t brokenTexCoords_ = 0;
};

} // namespace metamarch
