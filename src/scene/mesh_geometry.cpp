// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh_geometry.h"

#include "metamarch/scene/tangent_space.h"

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

constexpr std::uint32_t kNoCopy = 0xffffffffu;
constexpr glm::vec4 kAnyTangent(1.0f, 0.0f, 0.0f, 1.0f);

glm::vec3 unitOrZero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
}

// A vertex without a valid normal gets the normal of its triangle.
std::vector<TangentCorner> cornersOf(const MeshGeometry& geometry, std::uint32_t texCoordSet) {
    std::vector<TangentCorner> corners;
    corners.reserve(3 * geometry.triangles.size());
    for (const glm::uvec3& triangle : geometry.triangles) {
        const glm::vec3& origin = geometry.positions[triangle.x];
        const glm::vec3 front = unitOrZero(
            glm::cross(geometry.positions[triangle.y] - origin, geometry.positions[triangle.z] - origin));
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t vertex = triangle[i];
            const glm::vec3 normal =
                geometry.normals.empty() ? glm::vec3(0.0f) : unitOrZero(geometry.normals[vertex]);
            const glm::vec2 texCoord = geometry.texCoords[texCoordSet][vertex];
            corners.push_back({geometry.positions[vertex], normal == glm::vec3(0.0f) ? front : normal,
                               glm::vec2(texCoord.x, 1.0f - texCoord.y)});
        }
    }
    return corners;
}

// Appends a copy of all attributes of `vertex` except its tangent.
void copyVertex(MeshGeometry& geometry, std::uint32_t vertex) {
    const auto copy = [vertex](auto& values) {
        if (!values.empty()) {
            values.push_back(values[vertex]);
        }
    };
    copy(geometry.positions);
    copy(geometry.normals);
    for (std::vector<glm::vec2>& texCoords : geometry.texCoords) {
        copy(texCoords);
    }
    copy(geometry.colors);
}

} // namespace

void checkIndices(const InputFile& file, const std::string& label, const MeshGeometry& geometry) {
    const std::size_t count = geometry.positions.size();
    for (const glm::uvec3& triangle : geometry.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            if (triangle[corner] >= count) {
                file.refuse(label + ": index " + std::to_string(triangle[corner]) +
                            " is out of range, there are " + std::to_string(count) + " vertices");
            }
        }
    }
}

void addTangents(MeshGeometry& geometry, std::uint32_t texCoordSet) {
    const std::vector<glm::vec4> ofCorner = mikkTangents(cornersOf(geometry, texCoordSet));
    std::vector<glm::vec4>& tangents = geometry.tangents;
    tangents.assign(geometry.positions.size(), glm::vec4(0.0f));
    std::vector<std::uint32_t> nextCopy(geometry.positions.size(), kNoCopy);
    for (std::size_t i = 0; i < ofCorner.size(); ++i) {
        std::uint32_t& vertex = geometry.triangles[i / 3][static_cast<int>(i % 3)];
        // A zero tangent marks a vertex that no corner has used yet; real tangents are never zero.
        while (tangents[vertex] != glm::vec4(0.0f) && tangents[vertex] != ofCorner[i]) {
            if (nextCopy[vertex] == kNoCopy) {
                nextCopy[vertex] = static_cast<std::uint32_t>(geometry.positions.size());
                copyVertex(geometry, vertex);
                tangents.emplace_back(0.0f);
                nextCopy.push_back(kNoCopy);
            }
            vertex = nextCopy[vertex];
        }
        tangents[vertex] = ofCorner[i];
    }
    std::ranges::replace(tangents, glm::vec4(0.0f), kAnyTangent); // vertices that no triangle uses
}

} // namespace metamarch
