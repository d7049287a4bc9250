// SPDX-License-Identifier: MIT
// A ground that only takes shadow. The path tracer measures on it what objects take of its light, and the
// camera sees through it what is all around.
#pragma once
#include "metamarch/scene/scene.h"

#include <cstdint>
#include <string>

namespace metamarch {

// Where the ground is.
struct CatcherChoice {
    enum class Kind { none, plane, lowest, material };

    Kind kind = Kind::none;
    float height = 0.0f;    // of the plane y = height, in world units
    std::string material{}; // name or index of a material of the scene, whose surfaces are the ground

    bool operator==(const CatcherChoice&) const = default;

    bool isOn() const { return kind != Kind::none; }
    bool isPlane() const { return kind == Kind::plane || kind == Kind::lowest; }
};

// Returns the material of a scene by its name or index. Throws Error(invalidArgument), listing the materials,
// for one that does not exist.
std::uint32_t catcherMaterial(const Scene& scene, const std::string& selection);

// Returns the material of the ground's surfaces, for PathChoice::catcher. For a plane, or one right
// below the lowest point of the scene, adds a square with a material of its own, which is diffuse, to the
// scene. The square reaches 20 times the size of the scene beyond it, so that shadows end on it down to a sun
// 3 degrees above the horizon. Throws what catcherMaterial throws.
std::uint32_t placeCatcher(Scene& scene, const CatcherChoice& choice);

} // namespace metamarch
