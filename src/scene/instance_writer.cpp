#include "scene/instance_writer.h"

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

template <int N>
bool isFinite(const glm::vec<N, double>& v) {
    for (int axis = 0; axis < N; ++axis) {
        if (!std::isfinite(static_cast<float>(v[axis])))
            return false;
    }
    return true;
}

// The cofactor matrix carries normals even where the linear part is singular and has no inverse; with the
// determinant's sign it keeps them on their side of a mirrored surface. Scaled to entries of at most 1,
// because only directions matter and products of tiny scales would underflow.
glm::dmat3 normalMatrix(const glm::dmat4& toWorld, bool mirrored) {
    glm::dmat3 linear(toWorld);
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        largest = std::max(
            {largest, std::abs(linear[column].x), std::abs(linear[column].y), std::abs(linear[column].z)});
    if (largest > 0.0)
        linear /= largest;
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    return mirrored ? -cofactor : cofactor;
}

} // namespace

InstanceWriter::InstanceWriter(Scene& scene, SceneFile& file, const std::string& name, std::string label,
                               const glm::dmat4& toWorld)
    : scene_(scene), file_(file), label_(std::move(label)), partLabel_(label_), toWorld_(toWorld),
      mirrored_(glm::determinant(glm::dmat3(toWorld)) < 0.0),
      mesh_(static_cast<std::uint32_t>(scene.meshes.size())) {
    normalToWorld_ = normalMatrix(toWorld_, mirrored_);
    scene_.meshes.push_back({name});
}

void InstanceWriter::beginPart(std::string label, std::uint64_t vertexCount, std::uint64_t triangleCount,
                               std::uint32_t material) {
    partLabel_ = std::move(label);
    if (vertexCount > kMaxVertices - scene_.positions.size())
        file_.refuseSize(partLabel_ + ": the scene would have more than " + std::to_string(kMaxVertices) +
                         " vertices");
    if (triangleCount > kMaxTriangles - scene_.triangles.size())
        file_.refuseSize(partLabel_ + ": the scene would have more than " + std::to_string(kMaxTriangles) +
                         " triangles");
    firstVertex_ = static_cast<std::uint32_t>(scene_.positions.size());
    vertexCount_ = static_cast<std::uint32_t>(vertexCount);
    material_ = material;
}

void InstanceWriter::addVertex(const glm::dvec3& position, const std::optional<glm::dvec3>& normal,
                               const std::optional<glm::dvec2>& texCoord) {
    const glm::dvec3 worldPosition(toWorld_ * glm::dvec4(position, 1.0));
    if (!isFinite(worldPosition))
        file_.refuse(partLabel_ + ": position of vertex " +
                     std::to_string(scene_.positions.size() - firstVertex_) + " is not finite");
    scene_.positions.emplace_back(worldPosition);
    scene_.normals.push_back(normal ? worldNormal(*normal) : glm::vec3(0.0f));
    scene_.texCoords.push_back(texCoord ? checkedTexCoord(*texCoord) : glm::vec2(0.0f));
}

void InstanceWriter::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t index : {a, b, c}) {
        if (index >= vertexCount_)
            file_.refuse(partLabel_ + ": index " + std::to_string(index) + " is out of range, there are " +
                         std::to_string(vertexCount_) + " vertices");
    }
    if (mirrored_)
        std::swap(b, c);
    scene_.triangles.emplace_back(firstVertex_ + a, firstVertex_ + b, firstVertex_ + c);
    scene_.triangleMesh.push_back(mesh_);
    scene_.triangleMaterial.push_back(material_);
}

void InstanceWriter::finish() {
    if (brokenNormals_ > 0)
        file_.warn(label_ + ": " + std::to_string(brokenNormals_) +
                   " normals are zero or not finite; the triangles' own are used there");
    if (brokenTexCoords_ > 0)
        file_.warn(label_ + ": " + std::to_string(brokenTexCoords_) +
                   " texture coordinates are not finite; zero is used");
}

glm::vec3 InstanceWriter::worldNormal(const glm::dvec3& normal) {
    const double length = glm::length(normal);
    if (!std::isfinite(length) || length == 0.0) {
        ++brokenNormals_;
        return glm::vec3(0.0f);
    }
    const glm::dvec3 carried = normalToWorld_ * (normal / length);
    const double carriedLength = glm::length(carried);
    // A singular transform can flatten a sound normal to nothing: the file is not at fault, so nothing is
    // said.
    return std::isfinite(carriedLength) && carriedLength > 0.0 ? glm::vec3(carried / carriedLength)
                                                               : glm::vec3(0.0f);
}

glm::vec2 InstanceWriter::checkedTexCoord(const glm::dvec2& texCoord) {
    if (isFinite(texCoord))
        return glm::vec2(texCoord);
    ++brokenTexCoords_;
    return glm::vec2(0.0f);
}

} // namespace metamarch
