// SPDX-License-Identifier: MIT
#include "metamarch/scene/instance_writer.h"

#include "metamarch/scene/normal_matrix.h"

#include <cmath>

namespace metamarch {
namespace {

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Appends `convert` of each of the `count` values. If `values` is empty, appends `missing` `count` times.
template <class T, class Convert>
void append(std::vector<T>& to, const std::vector<T>& values, std::size_t count, const T& missing,
            const Convert& convert) {
    for (const T& value : values) {
        to.push_back(convert(value));
    }
    if (values.empty()) {
        to.insert(to.end(), count, missing);
    }
}

// Like append, for an array that stays empty until some part has values. `before` is the number of vertices
// before this part.
template <class T, class Convert>
void appendOptional(std::vector<T>& to, const std::vector<T>& values, std::size_t count, std::size_t before,
                    const T& missing, const Convert& convert) {
    if (values.empty() && to.empty()) {
        return;
    }
    to.resize(before, missing);
    append(to, values, count, missing, convert);
}

} // namespace

InstanceWriter::InstanceWriter(Scene& scene, InputFile& file, const MeshInstance& instance, std::string label,
                               const glm::dmat4& toWorld)
    : scene_(scene), file_(file), label_(std::move(label)), toWorld_(toWorld),
      normalToWorld_(normalMatrix(toWorld)), mirrored_(isMirroring(toWorld)),
      mesh_(static_cast<std::uint32_t>(scene.meshes.size())) {
    scene_.meshes.push_back(instance);
}

void InstanceWriter::write(const std::string& label, const MeshGeometry& part, std::uint32_t material) {
    checkRoom(label, part);
    const std::size_t before = scene_.positions.size();
    const std::size_t count = part.positions.size();
    writePositions(label, part);
    append(scene_.normals, part.normals, count, glm::vec3(0.0f),
           [this](const glm::vec3& normal) { return worldNormal(normal); });
    const auto texCoord = [this](const glm::vec2& value) { return checkedTexCoord(value); };
    append(scene_.texCoords, part.texCoords[0], count, glm::vec2(0.0f), texCoord);
    appendOptional(scene_.texCoords1, part.texCoords[1], count, before, glm::vec2(0.0f), texCoord);
    appendOptional(scene_.texCoords2, part.texCoords[2], count, before, glm::vec2(0.0f), texCoord);
    appendOptional(scene_.texCoords3, part.texCoords[3], count, before, glm::vec2(0.0f), texCoord);
    appendOptional(scene_.colors, part.colors, count, before, glm::vec4(1.0f),
                   [this](const glm::vec4& color) { return checkedColor(color); });
    appendOptional(scene_.tangents, part.tangents, count, before, glm::vec4(0.0f),
                   [this](const glm::vec4& tangent) { return worldTangent(tangent); });

    const auto first = static_cast<std::uint32_t>(before);
    for (const glm::uvec3& triangle : part.triangles) {
        scene_.triangles.push_back(first +
                                   (mirrored_ ? glm::uvec3(triangle.x, triangle.z, triangle.y) : triangle));
    }
    scene_.triangleMesh.resize(scene_.triangles.size(), mesh_);
    scene_.triangleMaterial.resize(scene_.triangles.size(), material);
}

void InstanceWriter::finish() {
    const auto report = [this](std::uint64_t count, const char* what) {
        if (count > 0) {
            file_.warn(label_ + ": " + std::to_string(count) + ' ' + what);
        }
    };
    report(brokenPositions_, "positions of vertices that no triangle uses are not finite; zero is used");
    report(brokenNormals_, "normals are zero or not finite; the triangles' own are used there");
    report(brokenTexCoords_, "texture coordinates are not finite; zero is used");
    report(brokenColors_, "colours are negative or not finite; white is used");
    report(brokenTangents_, "tangents are zero or not finite; any direction is used there");
}

void InstanceWriter::checkRoom(const std::string& label, const MeshGeometry& part) const {
    if (part.positions.size() > kMaxVertices - scene_.positions.size()) {
        file_.refuseSize(label + ": the scene would have more than " + std::to_string(kMaxVertices) +
                         " vertices");
    }
    if (part.triangles.size() > kMaxTriangles - scene_.triangles.size()) {
        file_.refuseSize(label + ": the scene would have more than " + std::to_string(kMaxTriangles) +
                         " triangles");
    }
}

void InstanceWriter::writePositions(const std::string& label, const MeshGeometry& part) {
    std::vector<std::size_t> broken;
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        const glm::vec3 position(toWorld_ * glm::dvec4(part.positions[i], 1.0));
        if (!isFinite(position)) {
            broken.push_back(i);
        }
        scene_.positions.push_back(isFinite(position) ? position : glm::vec3(0.0f));
    }
    if (broken.empty()) {
        return;
    }
    std::vector<bool> isUsed(part.positions.size(), false);
    for (const glm::uvec3& triangle : part.triangles) {
        isUsed[triangle.x] = isUsed[triangle.y] = isUsed[triangle.z] = true;
    }
    for (const std::size_t vertex : broken) {
        if (isUsed[vertex]) {
            file_.refuse(label + ": position of vertex " + std::to_string(vertex) + " is not finite");
        }
    }
    brokenPositions_ += broken.size();
}

glm::vec3 InstanceWriter::worldNormal(const glm::vec3& normal) {
    const double length = glm::length(glm::dvec3(normal));
    if (!std::isfinite(length) || length == 0.0) {
        ++brokenNormals_;
        return glm::vec3(0.0f);
    }
    // A singular transform can map a valid normal to zero. The file is not at fault, so there is no warning.
    const glm::dvec3 carried = normalToWorld_ * (glm::dvec3(normal) / length);
    const double carriedLength = glm::length(carried);
    return std::isfinite(carriedLength) && carriedLength > 0.0 ? glm::vec3(carried / carriedLength)
                                                               : glm::vec3(0.0f);
}

// A mirroring transform changes the sign of the bitangent.
glm::vec4 InstanceWriter::worldTangent(const glm::vec4& tangent) {
    const glm::dvec3 direction(tangent);
    const double length = glm::length(direction);
    if (!std::isfinite(length) || length == 0.0) {
        ++brokenTangents_;
        return glm::vec4(0.0f);
    }
    const glm::dvec3 carried = glm::dmat3(toWorld_) * (direction / length);
    const double carriedLength = glm::length(carried);
    if (!std::isfinite(carriedLength) || carriedLength == 0.0) {
        return glm::vec4(0.0f);
    }
    return glm::vec4(carried / carriedLength, (tangent.w < 0.0f) == mirrored_ ? 1.0 : -1.0);
}

glm::vec2 InstanceWriter::checkedTexCoord(const glm::vec2& texCoord) {
    if (std::isfinite(texCoord.x) && std::isfinite(texCoord.y)) {
        return texCoord;
    }
    ++brokenTexCoords_;
    return glm::vec2(0.0f);
}

glm::vec4 InstanceWriter::checkedColor(const glm::vec4& color) {
    for (int channel = 0; channel < 4; ++channel) {
        if (!(color[channel] >= 0.0f && std::isfinite(color[channel]))) {
            ++brokenColors_;
            return glm::vec4(1.0f);
        }
    }
    return color;
}

} // namespace metamarch
