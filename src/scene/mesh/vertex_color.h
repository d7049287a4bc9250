// SPDX-License-Identifier: MIT
// Colours of mesh files. No format says what their numbers mean. MeshLab shows them as they are and Blender
// takes them for sRGB, which is the same: so they are decoded from sRGB, whole numbers and fractions alike.
// Alpha is linear.
#pragma once
#include "metamarch/scene/material.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace metamarch {

// Fractions whose largest is not above this are fractions of 1: filters and rounding go a little above 1.
inline constexpr float kLargestFraction = 2.0f;

// The colours of a file's vertices or faces. How large a number means 1 is known only when all are there.
class FileColors {
  public:
    // Whether the file writes the numbers as fractions: then 1 means 1, unless one is above kLargestFraction.
    void setFractions(bool areFractions) { areFractions_ = areFractions; }

    void add(const glm::vec3& color, std::optional<float> alpha);

    bool empty() const { return colors_.empty(); }
    std::size_t size() const { return colors_.size(); }
    float largest() const { return largest_; } // of red, green and blue

    // Returns the colours, linear and in [0, 1] where the file's numbers are in range, and forgets them.
    std::vector<glm::vec4> decoded();

  private:
    std::vector<glm::vec4> colors_; // as the file has them
    float largest_ = 0.0f;
    float largestAlpha_ = 0.0f;
    bool areFractions_ = false;
};

// Returns the material of a surface that has these decoded colours: white, without metal, seen from both
// sides. It blends if an alpha is below 1, unless all are 0: then the program that wrote them did not mean
// them.
Material vertexColorMaterial(const std::vector<glm::vec4>& colors);

} // namespace metamarch
