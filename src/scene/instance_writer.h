// SPDX-License-Identifier: MIT
// Writes a mesh instance into a scene, in world space. All importers put their geometry into a Scene through
// this.
#pragma once
#include "metamarch/file/input_file.h"
#include "metamarch/scene/mesh_geometry.h"
#include "metamarch/scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace metamarch {

// Limits of a scene. One of the 32 bits of an index stays free for code that packs indices.
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 31;

class InstanceWriter {
  public:
    // `label` starts the messages about this mesh. If `toWorld` mirrors, the triangles' winding is reversed
    // so that front faces stay front faces. A singular `toWorld` is allowed.
    InstanceWriter(Scene& scene, InputFile& file, const MeshInstance& instance, std::string label,
                   const glm::dmat4& toWorld);

    // Appends a part (in glTF, a primitive) whose indices have been checked; `label` starts its error
    // messages. Throws Error(outOfMemory) if the scene would exceed kMaxVertices or kMaxTriangles, and
    // Error(inputRefused) if a world-space position of a triangle is not finite. Other positions, and broken
    // normals, texture coordinates, colours and tangents are replaced; finish() warns of them once for the
    // mesh.
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
    std::uint64_t brokenPositions_ = 0;
    std::uint64_t brokenNormals_ = 0;
    std::uint64_t brokenTexCoords_ = 0;
    std::uint64_t brokenColors_ = 0;
    std::uint64_t brokenTangents_ = 0;
};

} // namespace metamarch
