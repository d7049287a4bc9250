// Scene files to Scene.
#pragma once
#include "metamarch/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace metamarch {

// What of a file is wanted. Mesh files have neither variants nor animations.
struct ImportOptions {
    // Multiplies every position, camera and length of a material (finite, not zero), and the intensity of
    // point and spot lights by its square, so that the picture stays the same.
    float scale = 1.0f;
    std::string variant{}; // of KHR_materials_variants; empty: the materials that the primitives name
    // Seconds; every animation (or `animation` alone: a name or an index) poses the nodes at this time.
    // Without it they stand as the file's nodes say.
    std::optional<double> time{};
    std::string animation{};
    bool allowMissingTextures = false; // warn where a texture cannot be read, and go on without it

    bool operator==(const ImportOptions&) const = default;
};

// Reads glTF 2.0 (.gltf, .glb) through tinygltf and OBJ, PLY, OFF, STL through Assimp; the ending decides.
// Throws Error(inputRefused), naming file and element, for anything unreadable, out of range or not finite,
// and Error(invalidArgument), listing those that exist, for a variant or an animation that does not.
Scene loadScene(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace metamarch
