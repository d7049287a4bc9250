// Writes one mesh instance into a scene, in world space: the one place where importers' geometry becomes a
// Scene.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/mesh_geometry.h"
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace metamarch {

// Vertices and triangles a scene may have: one bit of the 32 stays free for whoever packs an index.
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 31;

class InstanceWriter {
  public:
    // `label` starts the lines about this mesh. A mirroring `toWorld` turns the triangles round, so that the
    // front stays the front; a singular one is allowed.
    InstanceWriter(Scene& scene, InputFile& file, const std::string& name, std::string label,
                   const glm::dmat4& toWorld);

    // Appends a part (glTF: a primitive), whose indices must have been checked; `label` starts its error
    // lines. Throws Error(outOfMemory) when the scene would grow past kMaxVertices or kMaxTriangles, and
    // Error(inputRefused) when a position in the world is not finite. Normals, texture coordinates, colours
    // and tangents that are broken are replaced, which finish() says once for the mesh.
    void write(const std::string& label, const MeshGeometry& part, std::uint32_t material);

    void finish();

  private:
    void checkRoom(const std::string& label, const MeshGeometry& part) const;
    void writePositions(const std::string& label, const MeshGeometry& part);
    glm::vec3 worldNormal(const glm::vec3& normal);
    glm::vec4 worldTangent(const glm::vec4& tangent);
    glm::vec2 checkedTexCoord(const glm::vec2& texCoord);
    glm::vec4 checkedColor(const glm::vec4& color);

    Scene& scene_;
    InputFile& file_;
    std::string label_;
    glm::dmat4 toWorld_;
    glm::dmat3 normalToWorld_;
    bool mirrored_;
    std::uint32_t mesh_;
    std::uint64_t brokenNormals_ = 0;
    std::uint64_t brokenTexCoords_ = 0;
    std::uint64_t brokenColors_ = 0;
    std::uint64_t brokenTangents_ = 0;
};

} // namespace metamarch
