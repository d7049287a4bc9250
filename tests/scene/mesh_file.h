// SPDX-License-Identifier: MIT
// Small mesh files that a test writes and reads.
#pragma once
#include "fixtures/temporary_folder.h"
#include "metamarch/scene/import.h"
#include "scene/gltf_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace metamarch {

class MeshFileTest : public testing::Test {
  protected:
    // Fails the test unless the file's warnings are `warnings`, without the path.
    Scene load(const std::string& name, const std::string& content,
               const std::vector<std::string>& warnings = {}) {
        writeFile(folder / name, content);
        Scene scene = loadScene(folder / name);
        for (std::string& warning : scene.warnings) {
            warning = warning.substr((folder / name).string().size() + 2);
        }
        EXPECT_EQ(scene.warnings, warnings) << content.substr(0, 400);
        return scene;
    }

    std::string refusal(const std::string& name, const std::string& content) {
        writeFile(folder / name, content);
        return refusalOf(folder / name);
    }

    TemporaryFolder folder;
};

inline double areaOf(const Scene& scene) {
    double area = 0.0;
    for (const glm::uvec3& triangle : scene.triangles) {
        const glm::dvec3 origin(scene.positions[triangle.x]);
        area += 0.5 * glm::length(glm::cross(glm::dvec3(scene.positions[triangle.y]) - origin,
                                             glm::dvec3(scene.positions[triangle.z]) - origin));
    }
    return area;
}

// The area that faces +z, less the area that faces -z.
inline double frontAreaOf(const Scene& scene) {
    double area = 0.0;
    for (const glm::uvec3& triangle : scene.triangles) {
        const glm::dvec3 origin(scene.positions[triangle.x]);
        area += 0.5 * glm::cross(glm::dvec3(scene.positions[triangle.y]) - origin,
                                 glm::dvec3(scene.positions[triangle.z]) - origin)
                          .z;
    }
    return area;
}

// Returns the colour of a corner of a triangle; `corner` counts over all triangles.
inline glm::vec4 colorOfCorner(const Scene& scene, std::size_t corner) {
    return scene.colors.at(scene.triangles.at(corner / 3)[static_cast<int>(corner % 3)]);
}

inline glm::vec2 texCoordOfCorner(const Scene& scene, std::size_t corner) {
    return scene.texCoords.at(scene.triangles.at(corner / 3)[static_cast<int>(corner % 3)]);
}

// Appends numbers as they lie in a binary file.
class BinaryText {
  public:
    explicit BinaryText(std::endian order) : order_(order) {}

    template <class T>
    BinaryText& add(const std::vector<T>& numbers) {
        for (const T number : numbers) {
            std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
            if (order_ != std::endian::native) {
                std::ranges::reverse(bytes);
            }
            text_ += bytes;
        }
        return *this;
    }

    const std::string& text() const { return text_; }

  private:
    std::endian order_;
    std::string text_;
};

} // namespace metamarch
