// SPDX-License-Identifier: MIT
// Imports scene files.
#pragma once
#include "metamarch/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace metamarch {

// What to import from a file. Mesh files have neither variants nor animations.
struct ImportOptions {
    // Multiplies all positions, cameras and material lengths, and, by its square, the intensity of point and
    // spot lights, so that the picture stays the same. Finite, not zero.
    float scale = 1.0f;
    // A scene of the file, by name or index; empty: the one that the file shows by default. Mesh files have
    // one scene.
    std::string scene{};
    // A variant of KHR_materials_variants; empty: the materials that the primitives name.
    std::string variant{};
    // The time in seconds at which all animations (or only `animation`, a name or an index) pose the nodes.
    // Without it the nodes stay where the file puts them.
    std::optional<double> time{};
    std::string animation{};
    bool allowMissingTextures = false; // if a texture cannot be read, warn and continue without it

    bool operator==(const ImportOptions&) const = default;
};

// Reads glTF 2.0 (.gltf, .glb) with tinygltf, and OBJ, PLY, OFF and STL; the file's ending decides. "-" is a
// GLB from standard input. Throws
// Error(inputRefused), naming file and element, for anything unreadable, out of range or not finite, and
// Error(invalidArgument), listing the existing ones, for an unknown scene, variant or animation.
Scene loadScene(const std::filesystem::path& file, const ImportOptions& options = {});

// Reads the bytes of a GLB, or of a glTF that names no other files. Messages call them `name`.
Scene loadGlb(const std::string& name, std::vector<unsigned char> glb, const ImportOptions& options = {});

} // namespace metamarch
