// Scene files to Scene.
#pragma once
#include "scene/scene.h"

#include <filesystem>

namespace metamarch {

// Reads glTF 2.0 (.gltf, .glb) through tinygltf and OBJ, PLY, OFF, STL through Assimp; the ending decides.
// Every position and camera is multiplied by `scale` (finite, not zero).
// Throws Error(sceneRefused), naming file and element, for anything unreadable, out of range or not finite.
Scene loadScene(const std::filesystem::path& file, float scale = 1.0f);

} // namespace metamarch
